#pragma once

#include <string>

#include "cloth_sim/model/cloth_model.h"
#include "cloth_sim/model/cloth_state.h"
#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// A scene at time 0, and in words how it got there: "catenary, between 2 pinned nodes".
struct SceneStart
{
  ClothState state;
  std::string description;
  bool is_settled = false;  ///< `settle` found it
};

/// The start of a scene whose sheet is `model`, in the shape that `cloth.start` names: `start_state` (flat);
/// `hung_in_catenaries`, relaxed where that leaves springs overstretched (catenary); or the rest that `settle` finds
/// from the catenaries, and where there are none from flat (settled). Pinned nodes are where the flat start has them,
/// velocities are the scene's. Throws SceneError, key cloth.start, where the scene has no such shape.
SceneStart scene_start(const SceneParams& scene, const ClothModel& model);

}  // namespace cloth
