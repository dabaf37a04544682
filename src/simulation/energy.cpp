#include "cloth_sim/simulation/energy.h"

#include <Eigen/Geometry>

#include "cloth_sim/forces/gravity.h"
#include "cloth_sim/forces/springs.h"

namespace cloth
{

Energies energies_of(const Dynamics& dynamics, const ClothState& state)
{
  const ClothModel& model = dynamics.model();
  Energies energies;
  energies.kinetic = 0.5 * model.masses.dot(state.velocities.rowwise().squaredNorm());
  energies.elastic = elastic_energy(model, state.positions);
  energies.gravitational = gravitational_energy(model, dynamics.gravity(), state.positions);
  return energies;
}

Eigen::Vector3d momentum_of(const ClothModel& model, const ClothState& state)
{
  return state.velocities.transpose() * model.masses;
}

Eigen::Vector3d angular_momentum_of(const ClothModel& model, const ClothState& state)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < model.nodes(); ++i)
  {
    const Eigen::Vector3d position = state.positions.row(i).transpose();
    const Eigen::Vector3d velocity = state.velocities.row(i).transpose();
    sum += model.masses[i] * position.cross(velocity);
  }
  return sum;
}

}  // namespace cloth
