#include "node_clock.h"

#include <algorithm>
#include <cmath>

namespace cloth
{

NodeClock::NodeClock(const NodeParams& node) : ticks_(node.rate, node.real_time_factor), paused_(node.start_paused)
{
  if (node.clock_mode == "master")
  {
    publisher_.emplace();
    begin_ = publisher_->time();
  }
}

ros::Time NodeClock::now() const
{
  return publisher_ ? publisher_->time() : ros::Time::now();
}

std::optional<Tick> NodeClock::take()
{
  if (paused_)
  {
    return std::nullopt;
  }
  const std::optional<Tick> tick = ticks_.take(pacing_time());
  return tick ? std::make_optional(stamped(*tick)) : std::nullopt;
}

Tick NodeClock::step()
{
  return stamped(ticks_.step(pacing_time()));
}

void NodeClock::show(const Tick& tick)
{
  if (publisher_)
  {
    publisher_->publish(tick.stamp);
  }
}

void NodeClock::set_paused(bool paused)
{
  if (paused != paused_)
  {
    paused_ = paused;
    ticks_.interrupt();
  }
}

void NodeClock::restart(const NodeParams& node)
{
  begin_ = now();
  ticks_ = TickClock(node.rate, node.real_time_factor);
}

ros::WallDuration NodeClock::rest() const
{
  // Simulated ROS time may pass at any speed, and a request or a shutdown may come: look often.
  constexpr double longest = 0.02;
  constexpr double look_at_clock = 0.001;
  if (paused_)
  {
    return ros::WallDuration(longest);
  }
  const double until_next = ticks_.until_next(pacing_time()).toSec();
  const bool clock_of_others = !publisher_ && ros::Time::isSimTime();
  return ros::WallDuration(clock_of_others || until_next == 0.0 ? look_at_clock : std::min(until_next, longest));
}

ros::Time NodeClock::pacing_time() const
{
  if (!publisher_)
  {
    return ros::Time::now();
  }
  const ros::SteadyTime now = ros::SteadyTime::now();
  return { now.sec, now.nsec };
}

Tick NodeClock::stamped(Tick tick) const
{
  if (publisher_)
  {
    // Counted from the beginning, so that no rounding error builds up.
    ros::Duration simulated;
    simulated.fromNSec(std::llround(tick.simulated_time * 1e9));
    tick.stamp = begin_ + simulated;
  }
  return tick;
}

}  // namespace cloth
