#pragma once

#include <Eigen/Core>

#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/model/cloth_state.h"

namespace cloth
{

/// J.
struct Energies
{
  double kinetic = 0.0;
  double elastic = 0.0;
  double gravitational = 0.0;  ///< zero at the origin's height

  double total() const
  {
    return kinetic + elastic + gravitational;
  }
};

Energies energies_of(const Dynamics& dynamics, const ClothState& state);

/// Sum of m_i v_i over all nodes, kg m/s.
Eigen::Vector3d momentum_of(const ClothModel& model, const ClothState& state);

/// Sum of x_i x m_i v_i over all nodes, about the origin, kg m2/s.
Eigen::Vector3d angular_momentum_of(const ClothModel& model, const ClothState& state);

}  // namespace cloth
