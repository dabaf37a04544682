#pragma once

#include <cstdint>
#include <string>

#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// Which scene of which matrix.
struct SceneNumber
{
  std::uint64_t seed = 1;
  int number = 0;
  int attempt = 0;         ///< how many draws of this number were refused before
  int most_per_side = 96;  ///< nodes
};

/// Even numbers are looked at while a planner is built; odd ones judge it.
enum class Half
{
  development,
  held_out
};

Half half_of(int number);
const char* name_of(Half half);

/// "007", and "007_2" of the second draw after a refused one.
std::string name_of(const SceneNumber& scene);

/// A scene drawn at random, the same on any machine; its start is smooth and has no symmetry. It has no strain limit:
/// with one there is no motion that does not depend on the method. `solver.method` and `plan` are auto.
SceneParams drawn_scene(const SceneNumber& scene);

/// The scene as a file that cloth_run and the node read.
std::string yaml_of(const SceneParams& scene);

}  // namespace cloth
