#pragma once

#include <Eigen/Core>

#include "cloth_sim/model/vectors.h"

namespace cloth
{

/// What one spring is made of.
struct Spring
{
  double stiffness;    ///< k, N/m
  double damping;      ///< c, N s/m
  double rest_length;  ///< l0, m
};

/// The force of a spring on its end i, in newtons; on end j it is the opposite. With l = x_j - x_i:
///
///   k (l - l0 l/|l|)  +  c ((v_j - v_i) . l/|l|) l/|l|
///
/// the elastic force (Provot 1995, section 3.1) and the internal damping along the spring. A spring of no length has
/// no direction and exerts no force.
/// This is the readable reference; `add_spring_forces` in springs.h does whole batches and is tested against it.
Eigen::Vector3d spring_force(const Spring& spring, const Eigen::Vector3d& position_i, const Eigen::Vector3d& position_j,
                             const Eigen::Vector3d& velocity_i, const Eigen::Vector3d& velocity_j);

/// Adds `force` to node i and its opposite to node j: Newton's third law, exact to the last bit of each term.
void add_to_both_ends(const Eigen::Vector3d& force, int i, int j, Vectors& forces);

}  // namespace cloth
