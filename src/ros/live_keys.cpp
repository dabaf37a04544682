#include "live_keys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "cloth_sim/scene/scene_reader.h"
#include "cloth_sim/scene/yaml_text.h"

namespace cloth
{
namespace
{

bool is_list(const Parameter<SceneParams>& parameter)
{
  return parameter.type.compare(0, 4, "list") == 0;
}

/// What `entries` hold for `name`, as YAML.
template <typename Entry>
std::optional<YAML::Node> found_in(const std::vector<Entry>& entries, const std::string& name)
{
  for (const Entry& entry : entries)
  {
    if (entry.name == name)
    {
      return YAML::Node(entry.value);
    }
  }
  return std::nullopt;
}

double nearest_allowed(const Parameter<SceneParams>& parameter, double value)
{
  return parameter.or_zero && value <= 0.0 ? 0.0 : std::clamp(value, parameter.low, parameter.high);
}

std::optional<YAML::Node> value_of(const Parameter<SceneParams>& parameter, const std::string& name,
                                   const dynamic_reconfigure::Config& values)
{
  if (parameter.type == "text")
  {
    return found_in(values.strs, name);
  }
  if (parameter.type == "integer")
  {
    const auto value = found_in(values.ints, name);
    return value ? YAML::Node(static_cast<int>(nearest_allowed(parameter, value->as<int>()))) : value;
  }
  for (const dynamic_reconfigure::DoubleParameter& entry : values.doubles)
  {
    if (entry.name == name)
    {
      const double value = std::isnan(entry.value) ? entry.value : nearest_allowed(parameter, entry.value);
      return YAML::Node(format_number(value));
    }
  }
  return std::nullopt;
}

/// The value that `values` have for the key; of a list those of its numbers that they have, in place of its own.
YAML::Node new_value_of(const Parameter<SceneParams>& parameter, const SceneParams& scene,
                        const dynamic_reconfigure::Config& values)
{
  YAML::Node value = YAML::Load(parameter.get(scene));
  const std::vector<std::string> names = flat_names_of(parameter);
  for (size_t i = 0; i < names.size(); ++i)
  {
    const std::optional<YAML::Node> given = value_of(parameter, names[i], values);
    if (given && is_list(parameter))
    {
      value[i] = *given;
    }
    else if (given)
    {
      value.reset(*given);
    }
  }
  return value;
}

template <typename Entry, typename Value>
void add(std::vector<Entry>& entries, const std::string& name, const Value& value)
{
  Entry entry;
  entry.name = name;
  entry.value = value;
  entries.push_back(entry);
}

}  // namespace

std::vector<std::string> flat_names_of(const Parameter<SceneParams>& parameter)
{
  std::string name = parameter.key;
  std::replace(name.begin(), name.end(), '.', '_');
  return is_list(parameter) ? std::vector<std::string>{ name + "_x", name + "_y", name + "_z" } :
                              std::vector<std::string>{ name };
}

dynamic_reconfigure::Config live_values_of(const SceneParams& scene)
{
  dynamic_reconfigure::Config values;
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    if (!parameter.live)
    {
      continue;
    }
    const YAML::Node value = YAML::Load(parameter.get(scene));
    const std::vector<std::string> names = flat_names_of(parameter);
    for (size_t i = 0; i < names.size(); ++i)
    {
      const YAML::Node one = is_list(parameter) ? value[i] : value;
      if (parameter.type == "text")
      {
        add(values.strs, names[i], one.as<std::string>());
      }
      else if (parameter.type == "integer")
      {
        add(values.ints, names[i], one.as<int>());
      }
      else
      {
        add(values.doubles, names[i], one.as<double>());
      }
    }
  }
  return values;
}

SceneParams with_live_values(SceneParams scene, const dynamic_reconfigure::Config& values)
{
  std::vector<std::string> faults;
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    if (!parameter.live)
    {
      continue;
    }
    const YAML::Node value = new_value_of(parameter, scene, values);
    try
    {
      parameter.set(value, scene);
    }
    catch (const std::invalid_argument&)
    {
      faults.push_back(parameter.key + " is " + shown(value) + "; allowed: " + parameter.allowed);
    }
  }
  if (!faults.empty())
  {
    throw SceneError(faults);
  }
  return scene;
}

}  // namespace cloth
