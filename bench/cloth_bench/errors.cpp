#include "errors.h"

#include <algorithm>
#include <cmath>

#include "cloth_sim/forces/springs.h"
#include "cloth_sim/simulation/energy.h"

namespace cloth
{

Errors errors_of(const Dynamics& dynamics, const std::vector<ClothState>& samples,
                 const std::vector<ClothState>& reference)
{
  Errors errors;
  errors.rms = rms_distance(samples, reference);
  for (size_t s = 0; s < reference.size(); ++s)
  {
    const ClothState& here = samples[s];
    const ClothState& there = reference[s];
    const double farthest = (here.positions - there.positions).rowwise().norm().maxCoeff<Eigen::PropagateNaN>();
    const double energy = energies_of(dynamics, here).total() - energies_of(dynamics, there).total();
    const double strain = max_strain(dynamics.model(), here.positions) - max_strain(dynamics.model(), there.positions);
    errors.worst = std::max(errors.worst, farthest);
    errors.energy = std::max(errors.energy, std::abs(energy));
    errors.strain = std::max(errors.strain, std::abs(strain));
  }
  return errors;
}

double rms_distance(const std::vector<ClothState>& samples, const std::vector<ClothState>& reference)
{
  double sum = 0.0;
  for (size_t s = 0; s < reference.size(); ++s)
  {
    sum += (samples[s].positions - reference[s].positions).squaredNorm() /
           static_cast<double>(reference[s].positions.rows());
  }
  return std::sqrt(sum / static_cast<double>(reference.size()));
}

}  // namespace cloth
