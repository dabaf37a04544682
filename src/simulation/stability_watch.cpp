#include "cloth_sim/simulation/stability_watch.h"

#include <algorithm>
#include <cmath>

namespace cloth
{
namespace
{

constexpr std::uint64_t steps_between_looks = 64;
constexpr std::uint64_t steps_between_spectra = 256;
constexpr double longest_age = 0.2;            // s
constexpr double longest_age_of_bounds = 0.4;  // s; of a limit that would follow from the bounds alone
constexpr double allowed_change = 1.05;

/// Whether any node's part in a bound has changed by what would change the limit, were it the largest.
bool have_changed(const Eigen::VectorXd& before, const Eigen::VectorXd& now)
{
  return before.size() != now.size() ||
         (now.size() > 0 && (now - before).cwiseAbs().maxCoeff() > (allowed_change - 1.0) * now.maxCoeff());
}

/// By so much that the limit is another.
bool is_above(const SpectrumBounds& one, const SpectrumBounds& other)
{
  return one.stiffness > allowed_change * other.stiffness || one.damping > allowed_change * other.damping;
}

}  // namespace

double StabilityWatch::limit(const MethodRow& method, const Dynamics& dynamics, const ClothState& state,
                             std::uint64_t steps, double enough)
{
  if (!of_any_shape_)
  {
    of_any_shape_ = network_stability_limit(method, spectrum_of_any_shape(dynamics));
  }
  if (*of_any_shape_ >= enough)
  {
    return *of_any_shape_;
  }
  if (known_ && steps - looked_at_ < steps_between_looks)
  {
    return limit_;
  }
  looked_at_ = steps;
  const SpectrumBounds bounds = spectrum_bounds(dynamics, state.positions);
  const bool has_stiffened = is_above(bounds, bounds_);
  const bool has_softened = is_above(bounds_, bounds);
  const bool may_be_long = steps - worked_out_at_ >= steps_between_spectra;
  const bool is_old = known_ && state.time - time_ >= (may_be_long ? longest_age : longest_age_of_bounds) &&
                      (have_changed(bounds_.node_stiffness, bounds.node_stiffness) ||
                       have_changed(bounds_.node_damping, bounds.node_damping));
  const bool may_have_grown = is_of_bound_ ? has_softened || may_be_long : is_old;
  if (known_ && !has_stiffened && (limit_ >= enough || !may_have_grown))
  {
    return limit_;
  }
  is_of_bound_ = known_ && !may_be_long;
  if (is_of_bound_ || std::isfinite(enough))
  {
    limit_ = network_stability_limit(method, spectrum_of(dynamics, state.positions, bounds));
    is_of_bound_ = is_of_bound_ || limit_ >= enough;
  }
  if (!is_of_bound_)
  {
    limit_ = network_stability_limit(method, spectrum_of(dynamics, state.positions));
  }
  known_ = true;
  bounds_ = bounds;
  time_ = state.time;
  worked_out_at_ = steps;
  return limit_;
}

}  // namespace cloth
