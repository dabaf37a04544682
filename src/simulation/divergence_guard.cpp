#include "cloth_sim/simulation/divergence_guard.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cloth_sim/forces/gravity.h"
#include "cloth_sim/simulation/energy.h"

namespace cloth
{
namespace
{

/// The longest that a node of a pin is carried, m.
double longest_way(const Pin& pin)
{
  const double farthest_from_pivot = pin.reach() + (pin.held_middle() - pin.carry.pivot).norm();
  return (pin.carry.to - pin.carry.from).norm() + pin.carry.turn.norm() * farthest_from_pivot;
}

/// The fastest that a pin can move, m/s.
double top_speed(const Pin& pin)
{
  constexpr double two_pi = 6.283185307179586;
  const double carry_time = pin.carry.end - pin.carry.start;
  const double carry_speed = carry_time > 0.0 ? longest_way(pin) / carry_time : 0.0;
  return two_pi * pin.oscillation.frequency * pin.oscillation.amplitude.norm() + carry_speed;
}

/// The farthest that a pin can move, m.
double reach(const Pin& pin)
{
  return 2.0 * pin.oscillation.amplitude.norm() + longest_way(pin);
}

/// The elastic energy of the sheet drawn out evenly by `distance` along its shorter side, J.
double stretching_energy(const ClothModel& model, double distance)
{
  const double side = model.cols == 1 ? model.height :
                      model.rows == 1 ? model.width :
                                        std::min(model.width, model.height);
  double energy = 0.0;
  for (const SpringBatch& batch : model.springs)
  {
    const double extension = batch.rest_length * distance / side;
    energy += 0.5 * batch.stiffness * batch.size() * extension * extension;
  }
  return energy;
}

double pin_motion_energy(const Dynamics& dynamics)
{
  double fastest = 0.0;
  double farthest = 0.0;
  for (const Pin& pin : dynamics.pins().all())
  {
    fastest = std::max(fastest, top_speed(pin));
    farthest = std::max(farthest, reach(pin));
  }
  return 0.5 * dynamics.model().masses.sum() * fastest * fastest + stretching_energy(dynamics.model(), farthest);
}

/// The most that the wind can do in a second: C (u - v) . v is largest at v = u/2.
double wind_power(const Dynamics& dynamics)
{
  const double top_speed = dynamics.air().top_speed();
  const double coupling = dynamics.air().properties().wind_coupling;
  return 0.25 * coupling * dynamics.model().areas.sum() * top_speed * top_speed;
}

int first_not_finite(const ClothState& state)
{
  for (int i = 0; i < state.positions.rows(); ++i)
  {
    if (!state.positions.row(i).allFinite() || !state.velocities.row(i).allFinite())
    {
      return i;
    }
  }
  return -1;
}

int fastest_node(const ClothState& state)
{
  Eigen::Index node = 0;
  state.velocities.rowwise().squaredNorm().maxCoeff(&node);
  return static_cast<int>(node);
}

}  // namespace

void DivergenceGuard::open(const Dynamics& dynamics, const ClothState& state)
{
  const ClothModel& model = dynamics.model();
  const Energies energies = energies_of(dynamics, state);
  // A sheet can fall by its own size without its middle having fallen yet.
  const double own_fall = model.masses.sum() * dynamics.gravity().norm() * std::hypot(model.width, model.height);
  opening_time_ = state.time;
  opening_gravitational_ = energies.gravitational;
  allowance_ = energies.kinetic + energies.elastic + own_fall + pin_motion_energy(dynamics);
}

void DivergenceGuard::allow_pin_motion(const Dynamics& dynamics)
{
  allowance_ += pin_motion_energy(dynamics);
}

std::optional<Divergence> DivergenceGuard::check(const Dynamics& dynamics, const ClothState& state) const
{
  const int lost = first_not_finite(state);
  if (lost >= 0)
  {
    return Divergence{ state.time, lost, "values are no longer finite" };
  }
  const ClothModel& model = dynamics.model();
  const double kinetic = 0.5 * model.masses.dot(state.velocities.rowwise().squaredNorm());
  const double fallen = opening_gravitational_ - gravitational_energy(model, dynamics.gravity(), state.positions);
  const double from_wind = wind_power(dynamics) * (state.time - opening_time_);
  const double put_in = allowance_ + std::max(0.0, fallen) + from_wind;
  if (kinetic > factor * put_in)
  {
    char cause[160];
    std::snprintf(cause, sizeof cause,
                  "kinetic energy of %.3g J is more than %g times the %.3g J that can have been put in", kinetic,
                  factor, put_in);
    return Divergence{ state.time, fastest_node(state), cause };
  }
  return std::nullopt;
}

}  // namespace cloth
