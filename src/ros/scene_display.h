#pragma once

#include <string>

#include "cloth_sim/model/cloth_model.h"
#include "cloth_sim/scene/scene_params.h"

#include "mesh_marker.h"

namespace cloth
{

/// The mesh of `model`, which must outlive it, as `scene` wants it drawn: colouring, and the way a chain's ribbon lies.
MeshMarker mesh_marker_of(const ClothModel& model, const std::string& frame_id, const SceneParams& scene);

}  // namespace cloth
