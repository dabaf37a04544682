#pragma once

#include "cloth_sim/scene/plan.h"

namespace cloth
{

/// The plan of a scene that goes on from a recording: `start_bag` at `start_time`. Positions and velocities (0 where
/// none were recorded) are those of the recorded state, and nodes are held where it has them: by the scene's pins,
/// whose motion goes on, as far as those held them, the others by a pin called `recorded`. Throws SceneError where
/// there is no such state, or it is of another sheet.
Plan plan_from_recording(const SceneParams& scene);

}  // namespace cloth
