#pragma once

#include "cloth_sim/constraints/strain_limit.h"
#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/methods/method.h"

namespace cloth
{

/// One step of `h` seconds with all that belongs to it: the method's own, which obeys the strain limit within where it
/// does so, and the limit after it. Where given, `impulses` gets what the limit gives to held nodes, N s.
StepReport take_whole_step(Method& method, StrainLimit& limit, const Dynamics& dynamics, double h, ClothState& state,
                           Vectors* impulses = nullptr);

}  // namespace cloth
