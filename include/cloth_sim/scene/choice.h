#pragma once

#include <limits>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace cloth
{

/// What was chosen for a scene: a run depends on this, the scene and the program alone.
struct Choice
{
  std::vector<std::string> left_out;  ///< parts that a trial found not to matter, by the names of the plan's lines
  std::string method;
  double time_step = 0.0;                                   ///< s; 0: 0.9 of the stability limit as the cloth deforms
  double tolerance = 1e-3;                                  ///< m a step, of a method that chooses its steps
  int iterations = 10;                                      ///< a step, of a method that iterates
  double error = std::numeric_limits<double>::quiet_NaN();  ///< estimated, m: root mean square over all nodes and over
                                                            ///< 1 s; not a number: not asked for
  double cost = std::numeric_limits<double>::quiet_NaN();   ///< estimated, s of work for a simulated second; likewise
};

/// A choice as a map of YAML, as it is in the summary of cloth_run under `choice`.
void write_choice(YAML::Emitter& emitter, const Choice& choice);

/// The choice of a map that `write_choice` wrote, or of one that has it under `choice`. Throws SceneError with the key,
/// the value and what is allowed.
Choice read_choice(const YAML::Node& tree);

}  // namespace cloth
