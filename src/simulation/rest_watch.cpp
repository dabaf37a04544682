#include "cloth_sim/simulation/rest_watch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cloth_sim/forces/springs.h"
#include "cloth_sim/simulation/statics.h"

namespace cloth
{
namespace
{

constexpr double never = std::numeric_limits<double>::infinity();
constexpr double growth_of_windows = 2.0;
/// A drift must have been this much slower, at most, than what is let down by its weight alone.
constexpr double patience = 100.0;

double longest_row(const Vectors& rows)
{
  return std::sqrt(rows.rowwise().squaredNorm().maxCoeff());
}

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
  return rate > 0.0 ? std::max(RestWatch::shortest_window, 2.0 / rate) : never;
}

/// In which a sheet comes down that the air holds back, s; 0 without gravity.
double time_of_descent(const Dynamics& dynamics)
{
  const ClothModel& model = dynamics.model();
  const double gravity = dynamics.gravity().norm();
  return gravity > 0.0 ? dynamics.air().damping_rate(model) * std::hypot(model.width, model.height) / gravity : 0.0;
}

/// Whether the limit may have a spring in its hold.
bool limit_holds(const StrainLimit& limit, const ClothModel& model, const Vectors& positions)
{
  return limit.active() && max_strain(model, positions) > (1.0 - StrainLimit::most_margin) * limit.held_strain();
}

}  // namespace

RestWatch::RestWatch(double distance) : distance_(distance)
{
}

void RestWatch::Looks::add(const ClothState& state)
{
  if (number == 0)
  {
    time = state.time;
    positions = state.positions;
  }
  else
  {
    time += state.time;
    positions += state.positions;
  }
  ++number;
}

void RestWatch::begin(const Dynamics& dynamics, const ClothState& state)
{
  is_settled_ = false;
  window_ = telling_window(dynamics);
  if (distance_ > 0.0)
  {
    begin_window(state);
  }
}

void RestWatch::begin_settled(const Dynamics& dynamics, const ClothState& state)
{
  begin(dynamics, state);
  is_settled_ = state.velocities.isZero(0.0);
}

void RestWatch::begin_window(const ClothState& state)
{
  has_moved_ = false;
  begin_ = state.time;
  positions_ = state.positions;
  halves_[0].number = halves_[1].number = 0;
  next_look_ = begin_ + between_looks;
}

void RestWatch::take_look(const ClothState& state)
{
  const double way = longest_row(state.positions - positions_);
  if (!(way <= distance_))
  {
    begin_window(state);
    return;
  }
  has_moved_ = has_moved_ || way > 0.0;
  // A half has one look at least, however long steps are.
  const bool is_early = state.time - begin_ < 0.5 * window_ || halves_[0].number == 0;
  halves_[is_early ? 0 : 1].add(state);
  next_look_ = state.time + between_looks;
}

bool RestWatch::finds_rest(const Dynamics& dynamics, const StrainLimit& limit, const ClothState& state)
{
  if (distance_ == 0.0)
  {
    return false;
  }
  const bool is_settled = is_settled_;
  is_settled_ = false;
  if (is_driven(dynamics, state.time))
  {
    next_look_ = never;
    return false;
  }
  if (next_look_ == never)
  {
    begin_window(state);
  }
  if (is_settled)
  {
    return true;
  }
  const double duration = state.time - begin_;
  if (!has_moved_ && duration >= shortest_window && state.positions == positions_ && state.velocities.isZero(0.0))
  {
    return true;
  }
  if (duration < window_ || halves_[0].number == 0 || halves_[1].number == 0)
  {
    return false;
  }
  if (!drifts(dynamics) && would_stay(dynamics, limit, state))
  {
    return true;
  }
  window_ *= growth_of_windows;
  begin_window(state);
  return false;
}

bool RestWatch::drifts(const Dynamics& dynamics) const
{
  const auto& [first, second] = halves_;
  const double time = second.time / second.number - first.time / first.number;
  const double way = longest_row(second.positions / second.number - first.positions / first.number);
  return way * patience * std::max(1.0, time_of_descent(dynamics)) > distance_ * time;
}

bool RestWatch::would_stay(const Dynamics& dynamics, const StrainLimit& limit, const ClothState& state) const
{
  const ClothModel& model = dynamics.model();
  if (longest_row(state.positions - positions_) > distance_ || !holds_every_node(model, dynamics.pins()))
  {
    return false;
  }
  if (limit_holds(limit, model, state.positions))
  {
    return !dynamics.gravity().isZero(0.0);
  }
  return is_near_rest(model, dynamics.pins(), dynamics.gravity(), limit.held_strain(), distance_, state.positions);
}

}  // namespace cloth
