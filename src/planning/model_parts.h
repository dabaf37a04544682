#pragma once

#include <string>
#include <vector>

#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// What a grid of longer cells says of a part is believed where that changes the answer by less, or by more, than these
/// factors times what is asked about.
struct Belief
{
  double less;
  double more;
};

/// A part of the model that a sheet may do without.
struct ModelPart
{
  const char* name;  ///< as in the plan
  Belief belief;
  bool (*is_there)(const SceneParams& scene);
  void (*take_out)(SceneParams& scene);
};

using PartList = std::vector<std::string>;

/// Those that are dear enough to be worth a trial.
const std::vector<ModelPart>& optional_parts();

/// What is believed of all these parts together.
Belief belief_in_a_coarser_grid(const PartList& names);

/// The scene without the parts of these names.
SceneParams without(SceneParams scene, const PartList& names);

}  // namespace cloth
