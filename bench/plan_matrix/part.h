#pragma once

#include <set>
#include <string>
#include <vector>

#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// A part of the model that a scene may do without.
struct Part
{
  const char* name;  ///< of the plan's line
  bool (*is_in)(const SceneParams& scene);
  void (*remove)(SceneParams& scene);
};

/// All that a trial may find not to matter.
const std::vector<Part>& parts();

/// Names of parts.
using PartNames = std::set<std::string>;

/// The names of the parts that the scene has.
PartNames parts_of(const SceneParams& scene);

/// The scene without those parts. Throws std::invalid_argument where a name is no part's.
SceneParams without(const PartNames& names, SceneParams scene);

/// "flex springs+wind"; empty: none.
std::string joined(const PartNames& names);
/// And back.
PartNames names_in(const std::string& text);

}  // namespace cloth
