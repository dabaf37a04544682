#include "cloth_sim/simulation/stability_watch.h"

#include "cloth_sim/methods/spectrum.h"

namespace cloth
{
namespace
{

constexpr std::uint64_t steps_between_looks = 64;
constexpr std::uint64_t steps_between_spectra = 512;
constexpr double longest_age = 0.2;  // s
constexpr double allowed_change = 1.05;

}  // namespace

double StabilityWatch::limit(const MethodRow& method, const Dynamics& dynamics, const ClothState& state,
                             std::uint64_t steps)
{
  if (known_ && steps - looked_at_ < steps_between_looks)
  {
    return limit_;
  }
  looked_at_ = steps;
  const double bound = stiffness_bound(dynamics, state.positions);
  const bool has_stiffened = bound > allowed_change * bound_;
  const bool has_softened = allowed_change * bound < bound_;
  const bool is_old = state.time - time_ >= longest_age;
  const bool may_be_long = steps - worked_out_at_ >= steps_between_spectra;
  if (known_ && !has_stiffened && !may_be_long && (is_of_bound_ ? !has_softened : !is_old))
  {
    return limit_;
  }
  is_of_bound_ = known_ && !may_be_long;
  limit_ = network_stability_limit(
      method, is_of_bound_ ? spectrum_of(dynamics, state.positions, bound) : spectrum_of(dynamics, state.positions));
  known_ = true;
  bound_ = bound;
  time_ = state.time;
  worked_out_at_ = steps;
  return limit_;
}

}  // namespace cloth
