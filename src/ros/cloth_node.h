#pragma once

#include <string>

#include <geometry_msgs/Vector3Stamped.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <tf2/buffer_core.h>
#include <tf2_ros/transform_listener.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/Pin.h"
#include "cloth_sim/scene/plan.h"
#include "cloth_sim/simulation/simulation.h"

#include "frames.h"
#include "mesh_marker.h"
#include "pin_markers.h"
#include "refusal_log.h"
#include "request_queue.h"
#include "spring_marker.h"
#include "tick_clock.h"
#include "tick_statistics.h"

namespace cloth
{

/// A cloth in the ROS graph: ticks it by ROS time, publishes it, and takes requests. The thread in `run` owns the
/// simulation; callbacks may come from any other.
class ClothNode
{
public:
  /// `private_node` is the namespace of the topics. Throws what `make_plan` and `build_simulation` throw.
  ClothNode(const ros::NodeHandle& private_node, const Plan& plan);

  /// Ticks until ROS shuts down. Callbacks need a spinner of their own.
  void run();

private:
  void advertise();
  void subscribe();
  void log_start() const;

  void take_wind(const geometry_msgs::Vector3Stamped& request);
  void take_pin(const cloth_sim::Pin::ConstPtr& request);

  void run_tick(const Tick& tick);
  void apply_requests();
  void advance(double simulated_time);
  void publish_cloth(const ros::Time& stamp);
  void publish_topology();
  void publish_stats_when_due();
  void wait_for_tick() const;

  ros::NodeHandle private_node_;
  Plan plan_;
  Simulation simulation_;
  TickClock clock_;
  TickStatistics statistics_;
  RequestQueue requests_;
  RefusalLog refusals_;
  bool divergence_reported_ = false;

  tf2::BufferCore transforms_;
  tf2_ros::TransformListener transform_listener_;
  Frames frames_;

  MeshMarker mesh_marker_;
  SpringMarker spring_marker_;
  PinMarkers pin_markers_;
  cloth_sim::ClothState state_message_;

  ros::Publisher mesh_;
  ros::Publisher springs_;
  ros::Publisher pins_;
  ros::Publisher state_;
  ros::Publisher topology_;
  ros::Publisher stats_;
  ros::Subscriber wind_;
  ros::Subscriber pin_;
};

}  // namespace cloth
