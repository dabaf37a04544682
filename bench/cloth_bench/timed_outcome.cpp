#include "timed_outcome.h"

#include <algorithm>

namespace cloth
{

Outcome timed_outcome(const std::function<Outcome()>& run, double least_timed)
{
  Outcome outcome = run();
  double sum = outcome.seconds_per_second;
  double yardsticks = outcome.seconds_per_second / outcome.yardstick;
  int runs = 1;
  const bool is_complete = outcome.status == Status::ok || outcome.status == Status::not_converged;
  for (double timed = outcome.seconds; is_complete && timed < least_timed; ++runs)
  {
    const Outcome again = run();
    sum += again.seconds_per_second;
    yardsticks += again.seconds_per_second / again.yardstick;
    timed += std::max(again.seconds, 1e-6);
  }
  outcome.seconds_per_second = sum / runs;
  outcome.yardstick = yardsticks > 0.0 ? sum / yardsticks : outcome.yardstick;
  return outcome;
}

void take(const Outcome& outcome, Measurement& measurement)
{
  measurement.status = name_of(outcome.status);
  measurement.seconds = outcome.seconds;
  measurement.seconds_per_second = outcome.seconds_per_second;
  measurement.yardstick = outcome.yardstick;
  measurement.force_evaluations = outcome.force_evaluations;
  measurement.linear_solves = outcome.linear_solves;
}

}  // namespace cloth
