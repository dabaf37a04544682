#include "first_order_system.h"

namespace cloth
{

FirstOrderSystem::FirstOrderSystem(const Problem& problem)
  : simulation_(simulation_of(problem, "velocity_verlet", 1.0, {})), state_(simulation_.state())
{
  guard_.open(simulation_.dynamics(), state_);
}

void FirstOrderSystem::copy_start(double* y) const
{
  const ClothState& start = simulation_.state();
  Eigen::Map<Vectors>(y, start.positions.rows(), 3) = start.positions;
  Eigen::Map<Vectors>(y + start.positions.size(), start.positions.rows(), 3) = start.velocities;
}

void FirstOrderSystem::find_slopes(double time, const double* y, double* slopes)
{
  ++evaluations_;
  take(time, y, state_);
  simulation_.dynamics().accelerations(time, state_.positions, state_.velocities, accelerations_);
  Eigen::Map<Vectors>(slopes, state_.positions.rows(), 3) = state_.velocities;
  Eigen::Map<Vectors>(slopes + state_.positions.size(), state_.positions.rows(), 3) = accelerations_;
}

ClothState FirstOrderSystem::state_at(double time, const double* y) const
{
  ClothState state = state_;
  take(time, y, state);
  return state;
}

bool FirstOrderSystem::has_diverged(double time, const double* y) const
{
  return guard_.check(simulation_.dynamics(), state_at(time, y)).has_value();
}

void FirstOrderSystem::take(double time, const double* y, ClothState& state) const
{
  state.time = time;
  state.positions = Eigen::Map<const Vectors>(y, state.positions.rows(), 3);
  state.velocities = Eigen::Map<const Vectors>(y + state.positions.size(), state.positions.rows(), 3);
  simulation_.pins().impose(time, state.positions, state.velocities);
}

}  // namespace cloth
