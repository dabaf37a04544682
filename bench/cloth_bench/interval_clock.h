#pragma once

#include "processor_time.h"
#include "solver.h"
#include "yardstick.h"

namespace cloth
{

/// Times a run interval by interval, in the processor's time, so that other programs decide neither what it costs nor
/// which runs there are. The first interval counts for nothing but the time left: what a solver makes once, it makes
/// there, and it fills the caches. The yardstick is laid beside every interval.
class IntervalClock
{
public:
  IntervalClock(const Problem& problem, double most_seconds) : problem_(problem), most_seconds_(most_seconds)
  {
  }

  template <typename Work>
  void time(Work&& work)
  {
    const double begin = processor_seconds();
    work();
    const double seconds = processor_seconds() - begin;
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
  const Problem& problem_;
  double most_seconds_;
  double begin_ = processor_seconds();
  double length_before_ = Yardstick::shared().length();
  double counted_ = 0.0;
  double yardsticks_ = 0.0;
  int intervals_ = 0;
};

}  // namespace cloth
