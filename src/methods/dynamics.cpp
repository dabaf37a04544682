#include "cloth_sim/methods/dynamics.h"

#include <utility>

#include "cloth_sim/forces/gravity.h"
#include "cloth_sim/forces/springs.h"

namespace cloth
{

Dynamics::Dynamics(ClothModel model, const Eigen::Vector3d& gravity, const AirProperties& air)
  : model_(std::move(model)), gravity_(gravity), air_(air), pins_(model_.nodes())
{
}

void Dynamics::external_forces(double /*time*/, Vectors& forces) const
{
  forces.setZero(model_.nodes(), 3);
  add_gravity(model_, gravity_, forces);
}

void Dynamics::forces_without_air(double time, const Vectors& positions, const Vectors& velocities,
                                  Vectors& forces) const
{
  external_forces(time, forces);
  add_spring_forces(model_, positions, velocities, forces);
}

void Dynamics::forces(double time, const Vectors& positions, const Vectors& velocities, Vectors& forces) const
{
  forces_without_air(time, positions, velocities, forces);
  air_.add_forces(model_, time, positions, velocities, forces);
}

void Dynamics::unheld_accelerations_of(const Vectors& forces, Vectors& accelerations) const
{
  accelerations = forces.array().colwise() / model_.masses.array();
}

void Dynamics::accelerations_of(const Vectors& forces, Vectors& accelerations) const
{
  unheld_accelerations_of(forces, accelerations);
  pins_.clear_held(accelerations);
}

void Dynamics::accelerations(double time, const Vectors& positions, const Vectors& velocities,
                             Vectors& accelerations) const
{
  forces(time, positions, velocities, accelerations);
  accelerations_of(accelerations, accelerations);
}

}  // namespace cloth
