#include "node_scene.h"

#include <algorithm>

#include <ros/package.h>
#include <ros/param.h>

#include "cloth_sim/scene/parameter_table.h"
#include "cloth_sim/scene/scene_reader.h"

#include "conversions.h"

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
  XmlRpc::XmlRpcValue value;
  ros::param::get(private_namespace, value);
  const YAML::Node tree = to_yaml(value);
  return read_scene(describes_a_cloth(tree) ? tree : laid_over(default_scene(), tree));
}

SceneParams replay_scene_from_parameters(const std::string& private_namespace)
{
  XmlRpc::XmlRpcValue value;
  ros::param::get(private_namespace, value);
  YAML::Node tree = laid_over(YAML::Load("cloth: {width: 0.02, height: 0.02}"), to_yaml(value));
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
