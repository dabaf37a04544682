#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>
#include <ros/subscriber.h>
#include <tf2/buffer_core.h>
#include <tf2_ros/transform_listener.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothStats.h"
#include "cloth_sim/ClothTopology.h"
#include "cloth_sim/Pin.h"
#include "cloth_sim/scene/scene_params.h"

#include "errands.h"
#include "frames.h"
#include "health.h"
#include "live_cloth.h"
#include "node_clock.h"
#include "pin_handles.h"
#include "pin_wrenches.h"
#include "refusal_log.h"
#include "request_queue.h"
#include "reused_messages.h"
#include "tick_statistics.h"
#include "tuning.h"

namespace cloth
{

/// A cloth in the ROS graph: ticks it, publishes it, and takes requests. The thread in `run` owns the cloth; callbacks
/// may come from any other.
class ClothNode
{
public:
  /// `private_node` is the namespace of the topics, the services, and of the parameters that ~reload reads. Throws what
  /// `LiveCloth` and `NodeClock` throw.
  ClothNode(const ros::NodeHandle& private_node, const SceneParams& scene);

  /// Ticks until ROS shuts down or `stop` is called. Callbacks need a spinner of their own.
  void run();

  /// Has `run` end soon. From any thread.
  void stop()
  {
    stops_ = true;
  }

private:
  void advertise();
  void advertise_services();
  void subscribe();

  void take_wind(const geometry_msgs::Vector3Stamped& request);
  void take_pin(const cloth_sim::Pin& request);
  void leave_pin(const std::string& topic, const cloth_sim::Pin& request);
  void take_point(const geometry_msgs::PointStamped& point);
  void apply(const cloth_sim::Pin& request);
  void take_feedback(const PinHandles::Feedback::ConstPtr& feedback);
  /// Leaves the request for the next tick; a refusal, now or then, is reported as one of `topic`.
  void leave(const std::string& topic, const RequestQueue::Request& request);
  void report_refusal(const std::string& topic, const std::function<void()>& action);

  Answer set_paused(bool paused);
  Answer step();
  Answer reset();
  Answer reload();
  Answer replace_cloth(std::unique_ptr<LiveCloth> next);
  /// Gives the scene that is in force then. Throws SceneError: the cloth goes on as it was.
  SceneParams tune(const SceneParams& scene);
  Answer tune_cloth(const SceneParams& scene);

  bool goes_on() const;
  void run_tick(const Tick& tick);
  void idle();
  bool apply_requests();
  /// Errands that wait for a tick that takes long are done on the way. False: the cloth was started over meanwhile, or
  /// the node ends, and the rest of the tick is left out.
  bool advance(double simulated_time);
  void report_divergence();
  /// Wind that came by topic, or the scene's where none came for long.
  bool apply_wind();
  void bring_back_what_was_left_out();
  void warn_where_wind_has_no_effect();
  void carry_pins(double simulated_time);
  /// Whether what the cloth does to the holders of its pins is measured: for listeners only.
  bool prepare_wrenches();
  void start_over();
  void publish_cloth(const ros::Time& stamp);
  void show_handles();
  void publish_topology();
  void publish_topology_if_changed();
  void publish_stats_when_due();
  void publish_diagnostics_when_due();

  ros::NodeHandle private_node_;
  std::unique_ptr<LiveCloth> cloth_;
  NodeClock clock_;
  std::atomic<bool> stops_{ false };
  TickStatistics statistics_;
  Errands errands_;
  RequestQueue requests_;
  RefusalLog refusals_;
  RefusalLog pin_warnings_;
  bool divergence_reported_ = false;
  bool started_over_ = false;                                    ///< since the last tick began
  std::optional<TickStatistics::Clock::time_point> tick_begin_;  ///< of the tick that is under way
  bool powerless_wind_reported_ = false;

  tf2::BufferCore transforms_;
  tf2_ros::TransformListener transform_listener_;
  Frames frames_;

  ReusedMessages<cloth_sim::ClothState> state_messages_;
  cloth_sim::ClothState::ConstPtr state_message_;  ///< the last
  cloth_sim::ClothTopology topology_message_;
  cloth_sim::ClothStats stats_message_;
  double tick_rate_ = 0.0;  ///< Hz, of the period of the stats

  ros::Publisher mesh_;
  ros::Publisher springs_;
  ros::Publisher pins_;
  ros::Publisher state_;
  ros::Publisher topology_;
  ros::Publisher stats_;
  ros::Subscriber wind_;
  ros::Subscriber pin_;
  ros::Subscriber pin_point_;
  std::array<ros::ServiceServer, 4> services_;
  std::string tuning_report_;  ///< what the last change of live keys led to beside what was asked for
  PinHandles handles_;
  PinWrenches wrenches_;
  Health health_;
  Tuning tuning_;
};

}  // namespace cloth
