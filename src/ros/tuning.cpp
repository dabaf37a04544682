#include "tuning.h"

#include <utility>

#include <ros/console.h>

#include "live_keys.h"
#include "node_scene.h"

namespace cloth
{
namespace
{

/// The server reads its values from the flat names when it is made.
const ros::NodeHandle& with_flat_names(const ros::NodeHandle& private_node, const SceneParams& scene)
{
  const dynamic_reconfigure::Config values = live_values_of(scene);
  const auto set_all = [&](const auto& entries) {
    for (const auto& entry : entries)
    {
      private_node.setParam(entry.name, entry.value);
    }
  };
  set_all(values.doubles);
  set_all(values.ints);
  set_all(values.strs);
  return private_node;
}

}  // namespace

Tuning::Tuning(const ros::NodeHandle& private_node, const SceneParams& scene, Apply apply)
  : private_node_(private_node)
  , scene_(scene)
  , apply_(std::move(apply))
  , server_(mutex_, with_flat_names(private_node_, scene_))
{
  bool is_first = true;  // the call by which the server hands over what it has read
  server_.setCallback([this, is_first](cloth_sim::ClothConfig& config, std::uint32_t /*level*/) mutable {
    is_first ? void(config = values_in_force()) : take(config);
    is_first = false;
  });
}

void Tuning::replace(const std::function<SceneParams()>& reload)
{
  const boost::recursive_mutex::scoped_lock lock(mutex_);
  scene_ = reload();
  server_.updateConfig(values_in_force());
}

void Tuning::take(cloth_sim::ClothConfig& config)
{
  dynamic_reconfigure::Config values;
  config.__toMessage__(values);
  try
  {
    const SceneParams asked = with_live_values(scene_, values);
    if (!(live_values_of(asked) == live_values_of(scene_)))
    {
      const SceneParams in_force = apply_(asked);
      write_back(private_node_.getNamespace(), scene_, in_force);
      scene_ = in_force;
    }
  }
  catch (const std::exception& refusal)
  {
    ROS_WARN("refused: tuning: %s", refusal.what());
  }
  config = values_in_force();
}

cloth_sim::ClothConfig Tuning::values_in_force() const
{
  cloth_sim::ClothConfig config = cloth_sim::ClothConfig::__getDefault__();
  dynamic_reconfigure::Config values = live_values_of(scene_);
  config.__fromMessage__(values);
  return config;
}

}  // namespace cloth
