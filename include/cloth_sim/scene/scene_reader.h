#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// A scene that cannot be used: one line a fault, each with the key, the value and what is allowed.
class SceneError : public std::runtime_error
{
public:
  explicit SceneError(const std::vector<std::string>& faults);
  explicit SceneError(const std::string& fault);
};

/// Reads and checks a scene tree; keys that are not there keep their defaults. An unknown key, a wrong type, and a
/// value that is out of range or not finite are faults; text that reads as the due number or list is taken as it.
/// Throws SceneError with all faults.
SceneParams read_scene(const YAML::Node& tree);

/// The tree of a YAML file. Throws SceneError with the file's name where it cannot be read or is no YAML.
YAML::Node load_scene_file(const std::string& path);

/// Sets the value at a dotted key (`solver.time_step`), `value` being YAML. Throws SceneError where the key or the
/// value cannot be read; whether the key exists is for `read_scene` to say.
void override_key(YAML::Node& tree, const std::string& key, const std::string& value);

}  // namespace cloth
