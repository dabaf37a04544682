#pragma once

#include <functional>

#include <boost/thread/recursive_mutex.hpp>

#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>

#include "cloth_sim/ClothConfig.h"
#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// The live keys of a running cloth, offered by dynamic_reconfigure in the node's private namespace. What is asked for
/// is brought into range and handed on; the answer is what is in force then, also where a change was refused. Changes
/// are written back to the scene's own keys.
class Tuning
{
public:
  /// Puts a scene that differs in live keys into force, and gives it as it is in force; throws where it is refused, and
  /// nothing has changed.
  using Apply = std::function<SceneParams(const SceneParams&)>;

  /// `scene` is in force. `apply` is called from the thread that serves callbacks.
  Tuning(const ros::NodeHandle& private_node, const SceneParams& scene, Apply apply);

  /// Runs `reload`, which puts another scene into force and gives it, while no change comes; shows its values.
  void replace(const std::function<SceneParams()>& reload);

private:
  void take(cloth_sim::ClothConfig& config);
  cloth_sim::ClothConfig values_in_force() const;

  ros::NodeHandle private_node_;
  SceneParams scene_;
  Apply apply_;
  boost::recursive_mutex mutex_;
  dynamic_reconfigure::Server<cloth_sim::ClothConfig> server_;
};

}  // namespace cloth
