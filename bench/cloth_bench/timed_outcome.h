#pragma once

#include <functional>

#include "measurement.h"
#include "solver.h"

namespace cloth
{

/// What comes of a run; a run that comes to its end in less than `least_timed` (s of processor time) is made again
/// until they come to that together, and its time is their mean.
Outcome timed_outcome(const std::function<Outcome()>& run, double least_timed);

/// Copies all but the errors.
void take(const Outcome& outcome, Measurement& measurement);

}  // namespace cloth
