#include "cloth_sim/simulation/stability_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cloth
{
namespace
{

constexpr std::uint64_t fewest_steps_between_looks = 8;
constexpr std::uint64_t most_steps_between_looks = 64;
/// How much bounds may change from one look to the next, relative, and how much later the next one may be.
constexpr double change_between_looks = 0.02;
constexpr double most_delay = 2.0;
constexpr std::uint64_t steps_between_spectra = 512;
constexpr double allowed_change = 1.05;

/// What an eigenvalue may have become since: modes about a node are as fast as its part in the bound at most, and grow
/// as that does where they were slower.
double grown(double eigenvalue, const Eigen::VectorXd& before, const Eigen::VectorXd& now)
{
  return eigenvalue * (now.array() / before.array().max(eigenvalue)).maxCoeff();
}

double relative_change(double before, double now)
{
  return std::abs(now - before) / std::max(before, std::numeric_limits<double>::min());
}

/// Of that which has changed most.
double relative_change(const SpectrumBounds& before, const SpectrumBounds& now)
{
  return std::max(relative_change(before.stiffness, now.stiffness), relative_change(before.damping, now.damping));
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
  if (known_ && steps - looked_at_ < steps_between_looks_)
  {
    return limit_;
  }
  const SpectrumBounds bounds = likely(spectrum_bounds(dynamics, state.positions));
  steps_between_looks_ = delay_of_next_look(bounds, steps);
  looked_at_ = steps;
  seen_ = bounds;
  const bool is_other = !known_ || is_above(bounds, bounds_) || is_above(bounds_, bounds);
  const bool may_be_long = !spectrum_ || steps - spectrum_at_ >= steps_between_spectra;
  const bool is_short = !is_exact_ && may_be_long && limit_ < enough;
  if (!is_other && !is_short)
  {
    return limit_;
  }
  known_ = true;
  bounds_ = bounds;
  limit_ = network_stability_limit(method, spectrum_of(dynamics, state.positions, bounds));
  is_exact_ = false;
  if (may_be_long && limit_ < enough)
  {
    take_spectrum(method, dynamics, state, steps);
  }
  return limit_;
}

/// As late as the bounds have changed by what they may if they go on as since the last look.
std::uint64_t StabilityWatch::delay_of_next_look(const SpectrumBounds& bounds, std::uint64_t steps) const
{
  if (!known_)
  {
    return fewest_steps_between_looks;
  }
  const double change = relative_change(seen_, bounds);
  const double factor = change * most_delay > change_between_looks ? change_between_looks / change : most_delay;
  const auto delay = static_cast<std::uint64_t>(factor * static_cast<double>(steps - looked_at_));
  return std::clamp(delay, fewest_steps_between_looks, most_steps_between_looks);
}

void StabilityWatch::take_spectrum(const MethodRow& method, const Dynamics& dynamics, const ClothState& state,
                                   std::uint64_t steps)
{
  spectrum_ = spectrum_of(dynamics, state.positions);
  spectrum_bounds_ = spectrum_bounds(dynamics, state.positions);
  spectrum_at_ = steps;
  bounds_ = likely(spectrum_bounds_);
  seen_ = bounds_;
  limit_ = network_stability_limit(method, *spectrum_);
  is_exact_ = true;
}

/// The bounds, made smaller by what the last spectrum says.
SpectrumBounds StabilityWatch::likely(SpectrumBounds bounds) const
{
  if (!spectrum_ || spectrum_->frequency == 0.0)
  {
    return bounds;
  }
  const double squared = spectrum_->frequency * spectrum_->frequency;
  const double stiffness =
      std::min(bounds.stiffness, grown(squared, spectrum_bounds_.node_stiffness, bounds.node_stiffness));
  const bool has_own_damping = bounds.node_damping.size() > 0 && spectrum_bounds_.node_damping.size() > 0 &&
                               spectrum_->most_spring_damping > 0.0;
  const double damping = has_own_damping ?
                             grown(spectrum_->most_spring_damping, spectrum_bounds_.node_damping, bounds.node_damping) :
                             bounds.damping * stiffness / bounds.stiffness;
  bounds.damping = std::min(bounds.damping, damping);
  bounds.stiffness = stiffness;
  return bounds;
}

}  // namespace cloth
