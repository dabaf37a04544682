#pragma once

#include "part.h"
#include "solver.h"

namespace cloth
{

/// What a planner makes of a scene.
struct TimedPlan
{
  Plan plan;
  double seconds = 0.0;     ///< that planning took
  double yardsticks = 0.0;  ///< likewise, in lengths of the yardstick
};

/// Throws what `make_plan` throws.
TimedPlan timed_plan(SceneParams scene, double tolerance);

/// The plan as a user runs it; gives up as too slow after about `most_seconds` of processor time.
Outcome run_of(const Plan& plan, const Problem& problem, double most_seconds);

/// What a trial found not to matter.
PartNames left_out(const Plan& plan);

}  // namespace cloth
