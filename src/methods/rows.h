#pragma once

#include "cloth_sim/methods/method.h"

namespace cloth
{

// One row a method, defined in the file that the method is written in.
extern const MethodRow symplectic_euler;
extern const MethodRow velocity_verlet;
extern const MethodRow rk4;

}  // namespace cloth
