#pragma once

#include <Eigen/Core>

#include "cloth_sim/model/cloth_model.h"

namespace cloth
{

/// Adds m_i g to every node; g in m/s2.
void add_gravity(const ClothModel& model, const Eigen::Vector3d& gravity, Vectors& forces);

/// -sum of m_i g . x_i, in J: zero for a mass at the origin, at any z where g points along it.
double gravitational_energy(const ClothModel& model, const Eigen::Vector3d& gravity, const Vectors& positions);

}  // namespace cloth
