#pragma once

#include <string>
#include <vector>

#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// A scene file to be charted.
struct BenchScene
{
  std::string name;  ///< the file's, without folder and extension
  std::string text;  ///< what the file says
  SceneParams params;
};

/// Throws SceneError where a scene cannot be read, and where two have the same name.
std::vector<BenchScene> read_scenes(const std::vector<std::string>& files);

/// A number that tells texts apart, as text.
std::string fingerprint_of(const std::string& text);

}  // namespace cloth
