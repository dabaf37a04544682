#include "cloth_sim/forces/gravity.h"

namespace cloth
{

void add_gravity(const ClothModel& model, const Eigen::Vector3d& gravity, Vectors& forces)
{
  for (int d = 0; d < 3; ++d)
  {
    forces.col(d) += gravity[d] * model.masses;
  }
}

double gravitational_energy(const ClothModel& model, const Eigen::Vector3d& gravity, const Vectors& positions)
{
  return -model.masses.dot(positions * gravity);
}

}  // namespace cloth
