#pragma once

#include "cloth_sim/methods/method.h"

namespace cloth
{

// One row a method, defined in the file that the method is written in.
extern const MethodRow explicit_euler;
extern const MethodRow symplectic_euler;
extern const MethodRow velocity_verlet;
extern const MethodRow midpoint;
extern const MethodRow rk4;
extern const MethodRow dopri5;
extern const MethodRow implicit_euler;
extern const MethodRow implicit_midpoint;
extern const MethodRow tr_bdf2;
extern const MethodRow projective;
extern const MethodRow xpbd;

/// xpbd in mixed precision.
std::unique_ptr<Method> make_mixed_xpbd(const MethodSettings& settings);

/// For rows of methods that no mode makes unstable.
double no_stability_limit(const Mode& mode);

/// For rows of methods that have no settings.
template <typename MethodType>
std::unique_ptr<Method> make_plain(const MethodSettings& /*settings*/)
{
  return std::make_unique<MethodType>();
}

}  // namespace cloth
