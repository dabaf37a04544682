#include "tick_clock.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cloth
{
namespace
{

constexpr double nanoseconds = 1e9;

}  // namespace

TickClock::TickClock(double rate, double real_time_factor) : rate_(rate), real_time_factor_(real_time_factor)
{
}

std::optional<Tick> TickClock::take(const ros::Time& now)
{
  if (now.isZero())
  {
    return std::nullopt;
  }
  if (anchor_.isZero() || now < latest_)
  {
    start_at(now);
  }
  latest_ = now;
  if (real_time_factor_ == 0.0)
  {
    return next_tick(now);
  }
  drop_backlog(now);
  const ros::Time due = due_time();
  if (due > now)
  {
    return std::nullopt;
  }
  ++next_;
  return next_tick(due);
}

Tick TickClock::step(const ros::Time& now)
{
  return next_tick(now);
}

void TickClock::set_pace(double rate, double real_time_factor)
{
  if (rate == rate_ && real_time_factor == real_time_factor_)
  {
    return;
  }
  simulated_begin_ = simulated_time();
  taken_ = 0;
  if (!anchor_.isZero())
  {
    anchor_ = next_anchor(ros::Duration(1.0 / rate));
    next_ = 1;
  }
  rate_ = rate;
  real_time_factor_ = real_time_factor;
}

void TickClock::interrupt()
{
  anchor_ = ros::Time();
}

ros::Duration TickClock::until_next(const ros::Time& now) const
{
  if (anchor_.isZero() || real_time_factor_ == 0.0)
  {
    return ros::Duration(0.0);
  }
  return std::max(ros::Duration(0.0), due_time() - now);
}

double TickClock::simulated_period() const
{
  return (real_time_factor_ == 0.0 ? 1.0 : real_time_factor_) / rate_;
}

ros::Time TickClock::next_anchor(const ros::Duration& period) const
{
  if (real_time_factor_ == 0.0)
  {
    return latest_;
  }
  const ros::Time last_due = due_time_of(next_ - 1);
  const bool has_backlog = due_time() <= latest_;
  return !has_backlog && latest_ - last_due > period ? latest_ - period : last_due;
}

double TickClock::simulated_time() const
{
  const double factor = real_time_factor_ == 0.0 ? 1.0 : real_time_factor_;
  return simulated_begin_ + static_cast<double>(taken_) * factor / rate_;
}

ros::Time TickClock::due_time() const
{
  return due_time_of(next_);
}

ros::Time TickClock::due_time_of(std::int64_t tick) const
{
  ros::Duration after_anchor;
  after_anchor.fromNSec(std::llround(static_cast<double>(tick) * nanoseconds / rate_));
  return anchor_ + after_anchor;
}

Tick TickClock::next_tick(const ros::Time& stamp)
{
  ++taken_;
  return { stamp, simulated_time() };
}

void TickClock::start_at(const ros::Time& now)
{
  anchor_ = now;
  next_ = 1;
}

void TickClock::drop_backlog(const ros::Time& now)
{
  const double latest_due = std::floor((now - anchor_).toSec() * rate_);
  const auto due = static_cast<std::int64_t>(latest_due) - next_ + 1;
  const auto kept = std::max<std::int64_t>(1, std::llround(max_backlog * rate_));
  if (due <= kept)
  {
    return;
  }
  const std::int64_t room = std::numeric_limits<std::uint32_t>::max() - overruns_;
  overruns_ += static_cast<std::uint32_t>(std::min(due - kept, room));
  next_ += due - kept;
}

}  // namespace cloth
