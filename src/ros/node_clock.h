#pragma once

#include <optional>

#include <ros/duration.h>
#include <ros/time.h>

#include "cloth_sim/scene/scene_params.h"

#include "clock_publisher.h"
#include "tick_clock.h"

namespace cloth
{

/// When the node ticks, and what ROS time it is: ROS time paces the ticks (clock_mode follow), or a wall clock paces
/// them and each takes ROS time on by as much as it simulates (master).
class NodeClock
{
public:
  /// Throws what `ClockPublisher` throws.
  explicit NodeClock(const NodeParams& node);

  bool is_master() const
  {
    return publisher_.has_value();
  }

  ros::Time now() const;

  /// The next tick, if it is due; never while paused.
  std::optional<Tick> take();
  /// The next tick, due or not.
  Tick step();
  /// Makes ROS time that of `tick`, once the cloth is there; nothing to do for who follows.
  void show(const Tick& tick);

  bool paused() const
  {
    return paused_;
  }
  /// Of the time that is paused nothing is caught up or counted.
  void set_paused(bool paused);

  /// Simulated time begins at 0 again, overruns too, ROS time goes on; paused or not as before.
  void restart(const NodeParams& node);

  /// The rate and the factor of `node` from now on; all else goes on.
  void set_pace(const NodeParams& node)
  {
    ticks_.set_pace(node.rate, node.real_time_factor);
  }

  /// Wall time for which the node may sleep, so that it comes in time for its next tick and for requests.
  ros::WallDuration rest() const;

  double simulated_period() const
  {
    return ticks_.simulated_period();
  }
  std::uint32_t overruns() const
  {
    return ticks_.overruns();
  }

private:
  ros::Time pacing_time() const;
  Tick stamped(Tick tick) const;

  std::optional<ClockPublisher> publisher_;
  ros::Time begin_;  ///< the ROS time at simulated time 0, where this node makes it
  TickClock ticks_;
  bool paused_;
};

}  // namespace cloth
