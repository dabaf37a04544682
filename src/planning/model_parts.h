#pragma once

#include <string>
#include <vector>

#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// A part of the model that a sheet may do without.
struct ModelPart
{
  const char* name;  ///< as in the plan
  bool (*is_there)(const SceneParams& scene);
  void (*take_out)(SceneParams& scene);
};

/// The name of the part that keeps short waves down, of which a coarser grid has none.
extern const char* const internal_damping;

using PartList = std::vector<std::string>;

/// Those that are dear enough to be worth a trial.
const std::vector<ModelPart>& optional_parts();

/// The scene without the parts of these names.
SceneParams without(SceneParams scene, const PartList& names);

}  // namespace cloth
