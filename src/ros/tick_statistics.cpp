#include "tick_statistics.h"

#include <algorithm>

namespace cloth
{

TickStatistics::TickStatistics(Clock::time_point start) : start_(start)
{
}

void TickStatistics::add(Clock::duration tick)
{
  ++ticks_;
  total_ += tick;
  longest_ = std::max(longest_, Milliseconds(tick));
}

TickReport TickStatistics::take(Clock::time_point now, double simulated_time)
{
  const std::chrono::duration<double> wall = now - start_;
  TickReport report;
  report.rate = ticks_ / wall.count();
  report.real_time_factor = (simulated_time - simulated_at_start_) / wall.count();
  report.tick_ms_mean = ticks_ > 0 ? total_.count() / ticks_ : 0.0;
  report.tick_ms_max = longest_.count();

  *this = TickStatistics(now);
  simulated_at_start_ = simulated_time;
  return report;
}

}  // namespace cloth
