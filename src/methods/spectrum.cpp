#include "cloth_sim/methods/spectrum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <Eigen/Eigenvalues>

#include "cloth_sim/forces/springs.h"

#include "block_bound.h"

namespace cloth
{
namespace
{

constexpr int most_lanczos_steps = 32;
constexpr int steps_between_ritz_values = 4;
constexpr double lanczos_residual = 0.02;  ///< small enough, in parts of the eigenvalue
constexpr double margin = 1.01;
/// In parts of omega. A bound below that which is half too large shortens a step of velocity Verlet by 6 %.
constexpr double damping_that_matters = 0.2;

Vectors noise(int nodes)
{
  std::mt19937 generator(1);
  Vectors vectors(nodes, 3);
  for (Eigen::Index i = 0; i < vectors.size(); ++i)
  {
    vectors.data()[i] = static_cast<double>(generator()) / generator.max() - 0.5;
  }
  return vectors;
}

/// An eigenvalue of a large matrix is at most `residual` away from `value`.
struct RitzValue
{
  double value = 0.0;
  double residual = 0.0;
};

/// The largest eigenvalue of the symmetric tridiagonal matrix that Lanczos made.
RitzValue largest_ritz_value(const std::vector<double>& diagonal, const std::vector<double>& beside)
{
  const Eigen::Index n = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), n),
                                Eigen::Map<const Eigen::VectorXd>(beside.data(), n - 1));
  return { solver.eigenvalues()[n - 1], beside.back() * std::abs(solver.eigenvectors()(n - 1, n - 1)) };
}

/// The largest eigenvalue of M^-1 K by Lanczos for M^-1/2 K M^-1/2, which has the same. Calls
/// add_product(model, positions, u, product) to add K u.
template <typename AddProduct>
double lanczos_estimate(const Dynamics& dynamics, const Vectors& positions, AddProduct&& add_product)
{
  const ClothModel& model = dynamics.model();
  const Eigen::ArrayXd inverse_roots = model.masses.array().rsqrt();
  Vectors q = noise(model.nodes());
  dynamics.pins().clear_held(q);
  if (q.isZero(0.0))
  {
    return 0.0;
  }
  q.normalize();
  Vectors previous = Vectors::Zero(model.nodes(), 3);
  Vectors scaled(model.nodes(), 3);
  Vectors product(model.nodes(), 3);
  std::vector<double> diagonal;
  std::vector<double> beside;
  double beta = 0.0;
  RitzValue ritz;
  for (int step = 0; step < most_lanczos_steps; ++step)
  {
    scaled = q.array().colwise() * inverse_roots;
    product.setZero();
    add_product(model, positions, scaled, product);
    dynamics.pins().clear_held(product);
    product.array().colwise() *= inverse_roots;
    diagonal.push_back(q.cwiseProduct(product).sum());
    product -= diagonal.back() * q + beta * previous;
    beta = product.norm();
    beside.push_back(beta);
    const bool is_last = step + 1 == most_lanczos_steps || beta == 0.0;
    if (is_last || (step + 1) % steps_between_ritz_values == 0)
    {
      ritz = largest_ritz_value(diagonal, beside);
      if (is_last || ritz.residual <= lanczos_residual * ritz.value)
      {
        break;
      }
    }
    previous.swap(q);
    q = product / beta;
  }
  return margin * (ritz.value + ritz.residual);
}

double largest_damping_ratio(const ClothModel& model)
{
  double largest = 0.0;
  for (const SpringBatch& batch : model.springs)
  {
    largest = std::max(largest, batch.damping / batch.stiffness);
  }
  return largest;
}

/// Twice the largest sum of what the springs of a free node have, over its mass.
double twice_the_largest_sum(const Dynamics& dynamics, double SpringBatch::*coefficient)
{
  const ClothModel& model = dynamics.model();
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(model.nodes());
  for (const SpringBatch& batch : model.springs)
  {
    for_each_spring(batch, [&](int i, int j) {
      sums[i] += batch.*coefficient;
      sums[j] += batch.*coefficient;
    });
  }
  Eigen::VectorXd inverse_masses(model.nodes());
  dynamics.pins().find_inverse_masses(model.masses, inverse_masses);
  return 2.0 * sums.cwiseProduct(inverse_masses).maxCoeff();
}

bool damping_matters(const SpectrumBounds& bounds)
{
  return bounds.damping > damping_that_matters * std::sqrt(bounds.stiffness);
}

}  // namespace

SpectrumBounds spectrum_bounds(const Dynamics& dynamics, const Vectors& positions)
{
  SpectrumBounds bounds;
  bounds.node_stiffness = block_bounds(dynamics, positions, [](const SpringBatch& batch) {
    return BlockCoefficients{ batch.stiffness, batch.stiffness };
  });
  bounds.stiffness = bounds.node_stiffness.maxCoeff();
  bounds.damping = largest_damping_ratio(dynamics.model()) * bounds.stiffness;
  if (damping_matters(bounds))
  {
    bounds.node_damping = block_bounds(dynamics, positions, [](const SpringBatch& batch) {
      return BlockCoefficients{ batch.damping, 0.0 };
    });
    bounds.damping = std::min(bounds.damping, bounds.node_damping.maxCoeff());
  }
  return bounds;
}

Spectrum spectrum_of(const Dynamics& dynamics, const Vectors& positions)
{
  SpectrumBounds bounds = spectrum_bounds(dynamics, positions);
  bounds.stiffness = std::min(bounds.stiffness, lanczos_estimate(dynamics, positions, add_stiffness_product));
  bounds.damping = std::min(bounds.damping, largest_damping_ratio(dynamics.model()) * bounds.stiffness);
  if (damping_matters(bounds))
  {
    bounds.damping = std::min(bounds.damping, lanczos_estimate(dynamics, positions, add_damping_product));
  }
  return spectrum_of(dynamics, positions, bounds);
}

Spectrum spectrum_of(const Dynamics& dynamics, const Vectors& positions, const SpectrumBounds& bounds)
{
  const ClothModel& model = dynamics.model();
  Spectrum spectrum;
  spectrum.frequency = std::sqrt(bounds.stiffness);
  spectrum.damping_ratio = largest_damping_ratio(model);
  const auto undamped_part = [&](const SpringBatch& batch) {
    const double damped = spectrum.damping_ratio > 0.0 ? batch.damping / spectrum.damping_ratio : 0.0;
    return BlockCoefficients{ batch.stiffness - damped, batch.stiffness };
  };
  const double undamped = block_bounds(dynamics, positions, undamped_part).maxCoeff();
  // A spring at rest is stretched by a rounding error at most, which stiffens nothing.
  const bool is_rounding = undamped <= 1e-12 * bounds.stiffness;
  spectrum.undamped_frequency = is_rounding ? 0.0 : std::sqrt(std::min(bounds.stiffness, undamped));
  spectrum.most_spring_damping = bounds.damping;
  spectrum.least_air_damping = dynamics.air().least_damping_rate(model);
  spectrum.most_air_damping = dynamics.air().damping_rate(model);
  return spectrum;
}

Spectrum spectrum_of_any_shape(const Dynamics& dynamics)
{
  const ClothModel& model = dynamics.model();
  Spectrum spectrum;
  spectrum.frequency = std::sqrt(twice_the_largest_sum(dynamics, &SpringBatch::stiffness));
  spectrum.undamped_frequency = spectrum.frequency;
  spectrum.damping_ratio = largest_damping_ratio(model);
  spectrum.most_spring_damping = twice_the_largest_sum(dynamics, &SpringBatch::damping);
  spectrum.least_air_damping = dynamics.air().least_damping_rate(model);
  spectrum.most_air_damping = dynamics.air().damping_rate(model);
  return spectrum;
}

namespace
{

/// The least limit of modes of one frequency, however they are damped.
double limit_at(const MethodRow& method, const Spectrum& spectrum, double frequency)
{
  const double squared = frequency * frequency;
  const double most = std::min(spectrum.most_spring_damping, spectrum.damping_ratio * squared);
  const double undamped = spectrum.undamped_frequency * spectrum.undamped_frequency;
  const double least = std::min(most, spectrum.damping_ratio * std::max(0.0, squared - undamped));
  const int parts = most > least ? 16 : 1;
  double limit = std::numeric_limits<double>::infinity();
  for (const double air : { spectrum.least_air_damping, spectrum.most_air_damping })
  {
    for (int p = 0; p <= parts; ++p)
    {
      const double spring = least + (most - least) * p / parts;
      limit = std::min(limit, method.stability_limit({ frequency, air, spring }));
    }
  }
  return limit;
}

}  // namespace

double network_stability_limit(const MethodRow& method, const Spectrum& spectrum)
{
  constexpr int parts = 16;
  double limit = limit_at(method, spectrum, spectrum.undamped_frequency);
  for (int p = 0; p <= parts; ++p)
  {
    limit = std::min(limit, limit_at(method, spectrum, spectrum.frequency * p / parts));
  }
  return limit;
}

double likely_limit(const MethodRow& method, const Spectrum& spectrum)
{
  double limit = std::numeric_limits<double>::infinity();
  const double most =
      std::min(spectrum.most_spring_damping, spectrum.damping_ratio * spectrum.frequency * spectrum.frequency);
  for (const double spring : { 0.0, most })
  {
    limit = std::min(limit, method.stability_limit({ spectrum.frequency, spectrum.most_air_damping, spring }));
  }
  return limit;
}

}  // namespace cloth
