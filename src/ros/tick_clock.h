#pragma once

#include <cstdint>
#include <optional>

#include <ros/duration.h>
#include <ros/time.h>

namespace cloth
{

/// One publish period of the cloth.
struct Tick
{
  ros::Time stamp;              ///< the ROS time at which it was due
  double simulated_time = 0.0;  ///< s, where the simulation is to stand at its end
};

/// Says when ticks are due: `rate` a second of ROS time, each real_time_factor/rate simulated seconds long. With a
/// real_time_factor of 0 the next is due at once, whatever the clock shows, and 1/rate simulated seconds long.
///
/// Ticks that a slow computer or a leaping clock left behind are caught up one after the other, as far as they lie no
/// more than `max_backlog` back; older ones are dropped, and the simulation falls behind ROS time by their length. When
/// time jumps backwards, the ticks go on from there; while it stands still, none is due.
///
/// Reads no clock itself: every call is told the time, zero meaning that there is none yet.
class TickClock
{
public:
  /// s; of this much, but at least of one tick
  static constexpr double max_backlog = 0.5;

  /// `rate` in Hz, positive; `real_time_factor` not negative.
  TickClock(double rate, double real_time_factor);

  /// The next tick, if it is due at `now`.
  std::optional<Tick> take(const ros::Time& now);

  /// The next tick, due or not, stamped `now`.
  Tick step(const ros::Time& now);

  /// Another rate and factor from now on: simulated time goes on from where the last tick has led it, and the next tick
  /// is due one new period after the last, at once where that is over.
  void set_pace(double rate, double real_time_factor);

  /// Leaves out the time until the next call of `take`: what falls due meanwhile is neither caught up nor counted.
  void interrupt();

  /// How long after `now`, the time of the last call of `take`, the next tick is due. Zero when it is due.
  ros::Duration until_next(const ros::Time& now) const;

  /// The simulated time between two ticks, s.
  double simulated_period() const;

  /// Ticks dropped so far.
  std::uint32_t overruns() const
  {
    return overruns_;
  }

private:
  /// s, where the last tick has led
  double simulated_time() const;
  ros::Time due_time() const;
  /// What the ticks are counted from when they become `period` long.
  ros::Time next_anchor(const ros::Duration& period) const;
  ros::Time due_time_of(std::int64_t tick) const;
  Tick next_tick(const ros::Time& stamp);
  void start_at(const ros::Time& now);
  void drop_backlog(const ros::Time& now);

  double rate_;
  double real_time_factor_;
  ros::Time anchor_;       ///< the ticks are counted from here, so that no rounding error builds up
  std::int64_t next_ = 0;  ///< number of the next tick after the anchor
  ros::Time latest_;
  double simulated_begin_ = 0.0;  ///< s, the simulated time from which the ticks taken are counted
  std::uint64_t taken_ = 0;
  std::uint32_t overruns_ = 0;
};

}  // namespace cloth
