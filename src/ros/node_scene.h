#pragma once

#include <string>

#include <yaml-cpp/yaml.h>

#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// The scene of the parameter server below `private_namespace`, fetched at once; what dynamic_reconfigure and
/// diagnostic_updater keep there is passed by. Where no key of the cloth itself is
/// set, only keys of the node or nothing, it is the package's config/hanging_sheet.yaml with the set keys laid over it.
/// Throws SceneError with all faults.
SceneParams scene_from_parameters(const std::string& private_namespace);

/// Sets those keys on the parameter server that differ between `before` and `after`, so that the scene read from there
/// is `after`. Where no key of the cloth itself is set, all of config/hanging_sheet.yaml is set first.
void write_back(const std::string& private_namespace, const SceneParams& before, const SceneParams& after);

/// What cloth_replay is told of the scene that was recorded: the same keys, none of which is needed; `bag` is no part
/// of it. A chain is 0.02 m wide where nothing else is said. Throws SceneError with all faults.
SceneParams replay_scene_from_parameters(const std::string& private_namespace);

/// Whether `tree` has a key other than those that only the node uses.
bool describes_a_cloth(const YAML::Node& tree);

/// `tree` without the flat names of live keys, which dynamic_reconfigure sets beside the scene's own keys, and without
/// diagnostic_updater's diagnostic_period.
YAML::Node without_names_of_tools(const YAML::Node& tree);

/// `base` with the values of `top` in place of its own, key by key.
YAML::Node laid_over(const YAML::Node& base, const YAML::Node& top);

}  // namespace cloth
