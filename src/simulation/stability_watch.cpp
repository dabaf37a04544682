#include "cloth_sim/simulation/stability_watch.h"

#include "cloth_sim/methods/spectrum.h"

namespace cloth
{
namespace
{

constexpr double longest_age = 0.2;  // s
constexpr double allowed_increase = 1.05;

}  // namespace

double StabilityWatch::limit(const MethodRow& method, const Dynamics& dynamics, const ClothState& state)
{
  const bool is_fresh = known_ && state.time - time_ < longest_age;
  const double bound = is_fresh && state.time == time_ ? bound_ : stiffness_bound(dynamics, state.positions);
  if (!is_fresh || bound > allowed_increase * bound_)
  {
    limit_ = network_stability_limit(method, spectrum_of(dynamics, state.positions));
    bound_ = bound;
    time_ = state.time;
    known_ = true;
  }
  return limit_;
}

}  // namespace cloth
