#include <sstream>

#include "cloth_sim/scene/parameter_table.h"
#include "cloth_sim/scene/yaml_text.h"

namespace cloth
{
namespace
{

template <typename Target>
std::string row_of(const Parameter<Target>& parameter)
{
  const std::string value = parameter.get(Target());
  std::ostringstream row;
  row << "| `" << parameter.key << "` | " << parameter.type << " | " << (value.empty() ? "-" : "`" + value + "`")
      << " | " << (parameter.unit.empty() ? "-" : parameter.unit) << " | " << parameter.allowed << " | "
      << parameter.meaning << " |\n";
  return row.str();
}

constexpr const char* header = "| key | type | default | unit | allowed | meaning |\n|---|---|---|---|---|---|\n";

std::string scene_rows(bool node_only)
{
  std::string rows = header;
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    rows += parameter.node_only == node_only ? row_of(parameter) : "";
  }
  return rows;
}

std::string live_keys()
{
  std::vector<std::string> keys;
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    if (parameter.live)
    {
      keys.push_back("- `" + parameter.key + "`\n");
    }
  }
  return joined(keys, "");
}

std::string pin_rows()
{
  std::string rows = header;
  for (const Parameter<PinParams>& parameter : pin_table())
  {
    rows += row_of(parameter);
  }
  return rows;
}

}  // namespace

std::string parameter_page()
{
  return R"(# Parameters

<!-- Made by `rosrun cloth_sim parameter_page > docs/parameters.md` from src/scene/parameter_table.cpp; do not edit. -->

One tree of keys, the same in a scene file and in the node's private namespace on the parameter server: the key
`cloth.rows` is `rows:` under `cloth:` in YAML and `~cloth/rows` in ROS. Every key has a default. An unknown key, a wrong
type and a value out of range are errors that name the key, the value and what is allowed. An integer serves as a
number, and text that reads as the due number or list is taken as it, since rosparam makes text of `1e-3` and
`[0,0,-1]`.

## Scene

)" + scene_rows(false) +
         R"(
## Pins

`pins` is a list; without it the two upper corners are held, and `pins: []` is a free sheet. Each entry has

)" + pin_rows() +
         R"(
A pin holds its nodes where they start. A node that two pins name belongs to the first; this is an error where the two
do not move alike.

## Node

Used by `cloth_node` only; `cloth_run` accepts and ignores them.

)" + scene_rows(true) +
         R"(
## While the node runs

These may be changed with dynamic_reconfigure, which calls them by flat names, `_` for `.`, a number of a list by `_x`,
`_y` or `_z`: `springs_flex_damping`, `air_wind_x`.

)" + live_keys();
}

}  // namespace cloth
