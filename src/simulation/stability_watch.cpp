#include "cloth_sim/simulation/stability_watch.h"

#include <algorithm>

namespace cloth
{
namespace
{

constexpr std::uint64_t steps_between_looks = 64;
constexpr std::uint64_t steps_between_spectra = 256;
constexpr double longest_age = 0.2;  // s
constexpr double allowed_change = 1.05;
constexpr double allowed_turn = 0.05;

/// Whether any spring, as a vector, has changed by more than allowed_turn of its length at rest. Stiffness is a
/// function of these vectors.
bool has_changed_shape(const ClothModel& model, const Vectors& before, const Vectors& now)
{
  return std::any_of(model.springs.begin(), model.springs.end(), [&](const SpringBatch& batch) {
    const double allowed = allowed_turn * batch.rest_length;
    bool found = false;
    for_each_spring(batch, [&](int i, int j) {
      const auto change = (now.row(j) - now.row(i)) - (before.row(j) - before.row(i));
      found = found || change.squaredNorm() > allowed * allowed;
    });
    return found;
  });
}

/// By so much that the limit is another.
bool is_above(const SpectrumBounds& one, const SpectrumBounds& other)
{
  return one.stiffness > allowed_change * other.stiffness || one.damping > allowed_change * other.damping;
}

}  // namespace

double StabilityWatch::limit(const MethodRow& method, const Dynamics& dynamics, const ClothState& state,
                             std::uint64_t steps)
{
  if (known_ && steps - looked_at_ < steps_between_looks)
  {
    return limit_;
  }
  looked_at_ = steps;
  const SpectrumBounds bounds = spectrum_bounds(dynamics, state.positions);
  const bool has_stiffened = is_above(bounds, bounds_);
  const bool has_softened = is_above(bounds_, bounds);
  const bool is_old =
      known_ && state.time - time_ >= longest_age && has_changed_shape(dynamics.model(), positions_, state.positions);
  const bool may_be_long = steps - worked_out_at_ >= steps_between_spectra;
  const bool is_outdated = has_stiffened || (is_of_bound_ ? has_softened || may_be_long : is_old);
  if (known_ && !is_outdated)
  {
    return limit_;
  }
  is_of_bound_ = known_ && !may_be_long;
  limit_ = network_stability_limit(
      method, is_of_bound_ ? spectrum_of(dynamics, state.positions, bounds) : spectrum_of(dynamics, state.positions));
  known_ = true;
  bounds_ = bounds;
  time_ = state.time;
  positions_ = state.positions;
  worked_out_at_ = steps;
  return limit_;
}

}  // namespace cloth
