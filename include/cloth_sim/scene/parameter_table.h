#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// One key: everything that is known about it. Target is what holds the value.
template <typename Target>
struct Parameter
{
  std::string key;      ///< dotted: cloth.rows
  std::string type;     ///< integer, number, text, or a list
  std::string unit;     ///< empty: none
  std::string allowed;  ///< the range in words
  std::string meaning;
  /// Takes the value into the target; throws std::invalid_argument where it is not allowed.
  std::function<void(const YAML::Node& value, Target& target)> set;
  /// The value as it is written in YAML.
  std::function<std::string(const Target& target)> get;
  bool node_only = false;  ///< used by the ROS node alone
  bool live = false;       ///< may change while the node runs
  // Of a number, an integer, and each number of a list: what is allowed besides, maybe, 0.
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool or_zero = false;
};

/// Every key of a scene but the list `pins`, in the order of the documentation. Defaults: a default SceneParams.
const std::vector<Parameter<SceneParams>>& parameter_table();

/// Every key of an entry of `pins`.
const std::vector<Parameter<PinParams>>& pin_table();

/// docs/parameters.md: the tables as a page.
std::string parameter_page();

}  // namespace cloth
