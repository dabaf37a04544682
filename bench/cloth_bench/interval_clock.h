#pragma once

#include <chrono>

#include "solver.h"

namespace cloth
{

/// Times a run interval by interval. The first one counts for nothing but the time left: what a solver makes once, it
/// makes there, and it fills the caches.
class IntervalClock
{
public:
  IntervalClock(const Problem& problem, double most_seconds) : problem_(problem), most_seconds_(most_seconds)
  {
  }

  template <typename Work>
  void time(Work&& work)
  {
    begin_ = Clock::now();
    is_running_ = true;
    work();
    is_running_ = false;
    const double seconds = since_begin();
    all_ += seconds;
    counted_ += intervals_++ == 0 ? 0.0 : seconds;
  }

  bool is_up() const
  {
    return all_ + (is_running_ ? since_begin() : 0.0) > most_seconds_;
  }

  void report(Outcome& outcome) const
  {
    outcome.seconds = all_;
    const int counted = intervals_ - 1;
    outcome.seconds_per_second = counted > 0 ? counted_ / (counted * problem_.sample_interval()) : 0.0;
  }

private:
  using Clock = std::chrono::steady_clock;

  double since_begin() const
  {
    return std::chrono::duration<double>(Clock::now() - begin_).count();
  }

  const Problem& problem_;
  double most_seconds_;
  Clock::time_point begin_;
  bool is_running_ = false;
  double all_ = 0.0;
  double counted_ = 0.0;
  int intervals_ = 0;
};

}  // namespace cloth
