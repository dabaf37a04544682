#include "cloth_sim/forces/spring_force.h"

namespace cloth
{

Eigen::Vector3d spring_force(const Spring& spring, const Eigen::Vector3d& position_i, const Eigen::Vector3d& position_j,
                             const Eigen::Vector3d& velocity_i, const Eigen::Vector3d& velocity_j)
{
  const Eigen::Vector3d l = position_j - position_i;
  const double length = l.norm();
  if (length == 0.0)
  {
    return Eigen::Vector3d::Zero();
  }
  const Eigen::Vector3d direction = l / length;
  const Eigen::Vector3d elastic = spring.stiffness * (l - spring.rest_length * direction);
  const Eigen::Vector3d damping = spring.damping * (velocity_j - velocity_i).dot(direction) * direction;
  return elastic + damping;
}

void add_to_both_ends(const Eigen::Vector3d& force, int i, int j, Vectors& forces)
{
  forces.row(i) += force.transpose();
  forces.row(j) -= force.transpose();
}

}  // namespace cloth
