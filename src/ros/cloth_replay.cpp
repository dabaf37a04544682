#include "cloth_replay.h"

#include <ros/console.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include "refused_request.h"

namespace cloth
{

ClothReplay::ClothReplay(const ros::NodeHandle& private_node, const SceneParams& scene, const std::string& bags)
  : private_node_(private_node)
  , scene_(scene)
  , troubles_([](const std::string& trouble) { ROS_WARN("%s", trouble.c_str()); })
{
  const std::string topology_topic = private_node_.resolveName("/cloth_node/topology");
  topologies_.add_from_bags(bags, topology_topic);
  constexpr bool latched = true;
  mesh_ = private_node_.advertise<visualization_msgs::Marker>("mesh", 5, latched);
  springs_ = private_node_.advertise<visualization_msgs::Marker>("springs", 5);
  pins_ = private_node_.advertise<visualization_msgs::MarkerArray>("pins", 5, latched);
  topology_ = private_node_.subscribe("/cloth_node/topology", 10, &ClothReplay::take_topology, this);
  state_ = private_node_.subscribe("/cloth_node/state", 100, &ClothReplay::take_state, this);
}

void ClothReplay::take_topology(const cloth_sim::ClothTopology::ConstPtr& topology)
{
  topologies_.add(topology);
  if (waiting_ != nullptr)
  {
    take_state(cloth_sim::ClothState::ConstPtr(waiting_));
  }
}

void ClothReplay::take_state(const cloth_sim::ClothState::ConstPtr& state)
{
  const auto topology = topologies_.find(state->topology_version, state->header.stamp);
  if (topology == nullptr)
  {
    waiting_ = state;
    troubles_.report("waiting for topology version " + std::to_string(state->topology_version) + " on " +
                     topology_.getTopic() + "; a recording played from its middle does not bring it: ~bag names the " +
                     "file to read it from");
    return;
  }
  waiting_.reset();
  try
  {
    show(*state, topology);
  }
  catch (const RefusedRequest& refusal)
  {
    troubles_.report("refused: " + std::string(refusal.what()));
  }
}

void ClothReplay::show(const cloth_sim::ClothState& state, const cloth_sim::ClothTopology::ConstPtr& topology)
{
  if (cloth_ == nullptr || cloth_->topology != topology)
  {
    change_to(topology, state.header.stamp);
  }
  cloth_->take(state);
  publish(state.header.stamp);
}

void ClothReplay::change_to(const cloth_sim::ClothTopology::ConstPtr& topology, const ros::Time& stamp)
{
  auto next = std::make_unique<ReplayedCloth>(topology, scene_);
  if (cloth_ != nullptr)
  {
    if (const auto markers = cloth_->pins.update({}, cloth_->positions, stamp))
    {
      pins_.publish(markers);
    }
  }
  cloth_ = std::move(next);
}

void ClothReplay::publish(const ros::Time& stamp)
{
  mesh_.publish(cloth_->mesh.update(cloth_->positions, stamp));
  if (springs_.getNumSubscribers() > 0)
  {
    springs_.publish(cloth_->springs.update(cloth_->positions, stamp));
  }
  publish_pins(stamp);
}

void ClothReplay::publish_pins(const ros::Time& stamp)
{
  // When time jumps back rviz forgets its markers, a little later than the states jump: pins that do not change are
  // published again then, and once a second.
  const bool due = stamp < pins_stamp_ || stamp >= pins_stamp_ + ros::Duration(1.0);
  auto markers = cloth_->pins.update(cloth_->held, cloth_->positions, stamp);
  if (markers == nullptr && due)
  {
    cloth_->forget_shown_pins();
    markers = cloth_->pins.update(cloth_->held, cloth_->positions, stamp);
  }
  if (markers != nullptr)
  {
    pins_.publish(markers);
    pins_stamp_ = stamp;
  }
}

}  // namespace cloth
