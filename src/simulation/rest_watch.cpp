#include "cloth_sim/simulation/rest_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cloth_sim/simulation/statics.h"

namespace cloth
{
namespace
{

constexpr double patience_growth = 2.0;

/// Whether something goes on that the state does not show: gusts, wind, pins that are not where they stay.
bool is_driven(const Dynamics& dynamics, double time)
{
  const std::vector<Pin>& pins = dynamics.pins().all();
  return (dynamics.air().is_coupled(dynamics.model()) && dynamics.air().top_speed() > 0.0) ||
         std::any_of(pins.begin(), pins.end(), [time](const Pin& pin) { return pin.moves_at(time); });
}

/// How long it takes until no mode can hide its speed, s; infinite where the air damps nothing.
double telling_window(const Dynamics& dynamics)
{
  const double rate = dynamics.air().least_damping_rate(dynamics.model());
  return rate > 0.0 ? std::max(RestWatch::shortest_window, 2.0 / rate) : std::numeric_limits<double>::infinity();
}

}  // namespace

RestWatch::RestWatch(double distance, bool starts_settled) : distance_(distance), starts_settled_(starts_settled)
{
}

void RestWatch::begin(const ClothState& state)
{
  patience_ = 1.0;
  if (distance_ > 0.0)
  {
    begin_window(state);
  }
}

void RestWatch::begin_window(const ClothState& state)
{
  has_moved_ = false;
  begin_ = state.time;
  positions_ = state.positions;
}

bool RestWatch::finds_rest(const Dynamics& dynamics, const StrainLimit& limit, const ClothState& state)
{
  if (distance_ == 0.0)
  {
    return false;
  }
  const bool asks_at_once = starts_settled_ && state.velocities.isZero(0.0);
  starts_settled_ = false;
  if (is_driven(dynamics, state.time))
  {
    begin_window(state);
    return false;
  }
  if (asks_at_once)
  {
    return would_stay(dynamics, limit, state);
  }
  const double squared_way = (state.positions - positions_).rowwise().squaredNorm().maxCoeff();
  if (!(squared_way <= distance_ * distance_))
  {
    begin_window(state);
    return false;
  }
  has_moved_ = has_moved_ || squared_way > 0.0;
  const double duration = state.time - begin_;
  if (!has_moved_ && duration >= shortest_window && state.velocities.isZero(0.0))
  {
    return true;
  }
  if (duration < patience_ * telling_window(dynamics))
  {
    return false;
  }
  if (would_stay(dynamics, limit, state))
  {
    return true;
  }
  patience_ *= patience_growth;
  begin_window(state);
  return false;
}

bool RestWatch::would_stay(const Dynamics& dynamics, const StrainLimit& limit, const ClothState& state) const
{
  return holds_every_node(dynamics.model(), dynamics.pins()) &&
         is_near_rest(dynamics.model(), dynamics.pins(), dynamics.gravity(), limit.held_strain(), distance_,
                      state.positions);
}

}  // namespace cloth
