#pragma once

#include <set>
#include <string>

#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// Parts of the model that a planner may leave out, by the names of the plan's lines.
using PartNames = std::set<std::string>;

/// Those that the scene has.
PartNames parts_of(const SceneParams& scene);

/// The scene without those parts. Throws std::invalid_argument where a name is no part's.
SceneParams without(const PartNames& names, const SceneParams& scene);

/// "flex springs+wind"; empty: none.
std::string joined(const PartNames& names);
/// And back.
PartNames names_in(const std::string& text);

}  // namespace cloth
