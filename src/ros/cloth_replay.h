#pragma once

#include <memory>
#include <string>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothTopology.h"
#include "cloth_sim/scene/scene_params.h"

#include "recorded_topologies.h"
#include "refusal_log.h"
#include "replayed_cloth.h"

namespace cloth
{

/// Turns the recorded states and topologies of a cloth, as `rosbag play` gives them, back into markers, as soon as both
/// parts of a cloth are there. Goes by the messages' stamps alone; those may jump back.
class ClothReplay
{
public:
  /// `private_node` is the namespace of the markers, `scene` tells how to draw. `bags` (as `bag_files` reads
  /// them) are read for topologies that do not come by topic. Throws what `RecordedTopologies::add_from_bags` throws.
  ClothReplay(const ros::NodeHandle& private_node, const SceneParams& scene, const std::string& bags);

private:
  void take_topology(const cloth_sim::ClothTopology::ConstPtr& topology);
  void take_state(const cloth_sim::ClothState::ConstPtr& state);

  void show(const cloth_sim::ClothState& state, const cloth_sim::ClothTopology::ConstPtr& topology);
  void change_to(const cloth_sim::ClothTopology::ConstPtr& topology, const ros::Time& stamp);
  void publish(const ros::Time& stamp);
  void publish_pins(const ros::Time& stamp);

  ros::NodeHandle private_node_;
  SceneParams scene_;
  RefusalLog troubles_;
  RecordedTopologies topologies_;
  std::unique_ptr<ReplayedCloth> cloth_;
  cloth_sim::ClothState::ConstPtr waiting_;  ///< the last state, while its topology has not come
  ros::Time pins_stamp_;

  ros::Publisher mesh_;
  ros::Publisher springs_;
  ros::Publisher pins_;
  ros::Subscriber topology_;
  ros::Subscriber state_;
};

}  // namespace cloth
