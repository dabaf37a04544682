#pragma once

#include "cloth_sim/simulation/simulation.h"

namespace cloth
{

/// The scene in which cloth solvers are compared: a sheet of 1 m by 1 m and 0.3 kg that starts level and is held at two
/// corners, springs as they are by default.
class LevelSheet
{
public:
  explicit LevelSheet(int nodes_a_side);

  ClothModel model;
  Vectors start;  ///< m
  int left = 0;   ///< the held nodes
  int right;
};

inline const MethodSettings one_iteration{ 1e-3, 1 };

/// It in a simulation, in still air that drags.
Simulation simulation_of(const LevelSheet& sheet, const StrainLimitProperties& limit, const char* method,
                         double time_step, const MethodSettings& settings = one_iteration);

}  // namespace cloth
