#pragma once

#include "cloth_sim/model/vectors.h"

namespace cloth
{

/// What changes while stepping.
struct ClothState
{
  Vectors positions;   ///< x, m
  Vectors velocities;  ///< v, m/s
  double time = 0.0;   ///< t, s
};

}  // namespace cloth
