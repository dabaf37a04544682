#include "node_scene.h"

#include <algorithm>

#include <ros/package.h>
#include <ros/param.h>

#include "cloth_sim/scene/parameter_table.h"
#include "cloth_sim/scene/scene_reader.h"

#include "conversions.h"
#include "live_keys.h"

namespace cloth
{
namespace
{

bool is_node_key(const std::string& key)
{
  const auto& table = parameter_table();
  return std::any_of(table.begin(), table.end(), [&](const auto& parameter) {
    return parameter.node_only && parameter.key.substr(0, parameter.key.find('.')) == key;
  });
}

bool is_name_of_tools(const std::string& name)
{
  const auto& table = parameter_table();
  return name == "diagnostic_period" || std::any_of(table.begin(), table.end(), [&](const auto& parameter) {
           const auto names = flat_names_of(parameter);
           return parameter.live && name != parameter.key && std::find(names.begin(), names.end(), name) != names.end();
         });
}

YAML::Node tree_of(const std::string& private_namespace)
{
  XmlRpc::XmlRpcValue value;
  ros::param::get(private_namespace, value);
  return without_names_of_tools(to_yaml(value));
}

std::string parameter_name(const std::string& private_namespace, std::string key)
{
  std::replace(key.begin(), key.end(), '.', '/');
  return private_namespace + "/" + key;
}

YAML::Node default_scene()
{
  const std::string package = ros::package::getPath("cloth_sim");
  if (package.empty())
  {
    throw SceneError("no scene is set, and the package cloth_sim with its default scene is not found");
  }
  return load_scene_file(package + "/config/hanging_sheet.yaml");
}

}  // namespace

SceneParams scene_from_parameters(const std::string& private_namespace)
{
  const YAML::Node tree = tree_of(private_namespace);
  return read_scene(describes_a_cloth(tree) ? tree : laid_over(default_scene(), tree));
}

void write_back(const std::string& private_namespace, const SceneParams& before, const SceneParams& after)
{
  if (!describes_a_cloth(tree_of(private_namespace)))
  {
    for (const auto& entry : default_scene())
    {
      ros::param::set(parameter_name(private_namespace, entry.first.as<std::string>()), to_parameter(entry.second));
    }
  }
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    const std::string value = parameter.get(after);
    if (value != parameter.get(before))
    {
      ros::param::set(parameter_name(private_namespace, parameter.key), to_parameter(YAML::Load(value)));
    }
  }
}

SceneParams replay_scene_from_parameters(const std::string& private_namespace)
{
  YAML::Node tree = laid_over(YAML::Load("cloth: {width: 0.02, height: 0.02}"), tree_of(private_namespace));
  tree.remove("bag");
  return read_scene(tree);
}

bool describes_a_cloth(const YAML::Node& tree)
{
  if (!tree.IsMap())
  {
    return !tree.IsNull();
  }
  return std::any_of(tree.begin(), tree.end(),
                     [](const auto& entry) { return !is_node_key(entry.first.template as<std::string>()); });
}

YAML::Node without_names_of_tools(const YAML::Node& tree)
{
  if (!tree.IsMap())
  {
    return tree;
  }
  YAML::Node rest(YAML::NodeType::Map);
  for (const auto& entry : tree)
  {
    const auto name = entry.first.as<std::string>();
    if (!is_name_of_tools(name))
    {
      rest[name] = entry.second;
    }
  }
  return rest;
}

YAML::Node laid_over(const YAML::Node& base, const YAML::Node& top)
{
  if (!base.IsMap() || !top.IsMap())
  {
    return top.IsNull() ? base : top;
  }
  YAML::Node merged = YAML::Clone(base);
  for (const auto& entry : top)
  {
    const auto key = entry.first.as<std::string>();
    merged[key] = base[key] ? laid_over(base[key], entry.second) : entry.second;
  }
  return merged;
}

}  // namespace cloth
