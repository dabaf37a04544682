#pragma once

#include <algorithm>
#include <limits>

#include "cloth_sim/threads/processor.h"

#include "solver.h"
#include "yardstick.h"

namespace cloth
{

/// Times a run interval by interval, in the processor's time and with the yardstick beside every interval, so that
/// other programs and a machine that is slower for a while decide neither what it costs nor which runs there are. The
/// first interval counts for nothing but the time left: what a solver makes once, it makes there, and it fills the
/// caches.
class IntervalClock
{
public:
  IntervalClock(const Problem& problem, double most_seconds) : problem_(problem), most_seconds_(most_seconds)
  {
  }

  template <typename Work>
  void time(Work&& work)
  {
    begin_ = processor_seconds();
    work();
    const double seconds = processor_seconds() - begin_;
    taken_ += undisturbed(seconds);
    begin_ = std::numeric_limits<double>::infinity();
    const double length = Yardstick::shared().length();
    if (intervals_++ > 0)
    {
      counted_ += seconds;
      yardsticks_ += seconds / (0.5 * (length_before_ + length));
    }
    length_before_ = length;
  }

  /// To be asked between intervals or within one.
  bool is_up() const
  {
    return taken_ + undisturbed(std::max(0.0, processor_seconds() - begin_)) > most_seconds_;
  }

  void report(Outcome& outcome) const
  {
    outcome.seconds = taken_;
    const int counted = intervals_ - 1;
    outcome.seconds_per_second = counted > 0 ? counted_ / (counted * problem_.sample_interval()) : 0.0;
    outcome.yardstick = yardsticks_ > 0.0 ? counted_ / yardsticks_ : length_before_;
  }

private:
  /// What `seconds` of now would have been on a machine that does nothing else.
  double undisturbed(double seconds) const
  {
    return seconds * Yardstick::shared().shortest() / length_before_;
  }

  const Problem& problem_;
  double most_seconds_;
  double begin_ = std::numeric_limits<double>::infinity();  ///< of the interval, s
  double taken_ = 0.0;                                      ///< s of an undisturbed machine
  double length_before_ = Yardstick::shared().length();
  double counted_ = 0.0;
  double yardsticks_ = 0.0;
  int intervals_ = 0;
};

}  // namespace cloth
