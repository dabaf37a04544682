#pragma once

#include <chrono>

#include <time.h>

#include "solver.h"
#include "yardstick.h"

namespace cloth
{

/// Times a run interval by interval. The first one counts for nothing but the time left: what a solver makes once, it
/// makes there, and it fills the caches. How long a run may take goes by the processor's time, so that other programs
/// do not decide which runs there are. The yardstick is laid beside every interval.
class IntervalClock
{
public:
  IntervalClock(const Problem& problem, double most_seconds) : problem_(problem), most_seconds_(most_seconds)
  {
  }

  template <typename Work>
  void time(Work&& work)
  {
    const WallClock::time_point begin = WallClock::now();
    work();
    const double seconds = std::chrono::duration<double>(WallClock::now() - begin).count();
    const double length = Yardstick::shared().length();
    if (intervals_++ > 0)
    {
      counted_ += seconds;
      yardsticks_ += seconds / (0.5 * (length_before_ + length));
    }
    length_before_ = length;
  }

  bool is_up() const
  {
    return processor_seconds() - begin_ > most_seconds_;
  }

  void report(Outcome& outcome) const
  {
    outcome.seconds = processor_seconds() - begin_;
    const int counted = intervals_ - 1;
    outcome.seconds_per_second = counted > 0 ? counted_ / (counted * problem_.sample_interval()) : 0.0;
    outcome.yardstick = yardsticks_ > 0.0 ? counted_ / yardsticks_ : length_before_;
  }

private:
  using WallClock = std::chrono::steady_clock;

  static double processor_seconds()
  {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }

  const Problem& problem_;
  double most_seconds_;
  double begin_ = processor_seconds();
  double length_before_ = Yardstick::shared().length();
  double counted_ = 0.0;
  double yardsticks_ = 0.0;
  int intervals_ = 0;
};

}  // namespace cloth
