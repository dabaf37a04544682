#pragma once

#include <string>
#include <vector>

#include "cloth_sim/scene/choice.h"

#include "part_trials.h"
#include "started_scene.h"
#include "step_costs.h"

namespace cloth
{

/// A choice, and why.
struct Planned
{
  Choice choice;
  std::vector<TriedPart> tried;
  std::string reason;  ///< for the method and its step
};

/// The cheapest model, method and step whose error over `Motion::horizon` is estimated to be below half of
/// solver.tolerance, from trial runs on a coarser grid. Parts are tried only where scene.plan is auto. Without a step
/// that meets the tolerance in real time, what comes nearest to it then (slower, where that is of no use), and all
/// parts. Throws SceneError where the scene cannot be stepped.
Planned plan_by_trial(const StartedScene& scene, StepCosts& costs);

}  // namespace cloth
