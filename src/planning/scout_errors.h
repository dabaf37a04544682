#pragma once

#include <vector>

#include "trials.h"

namespace cloth
{

/// How exact the scout is on the grid of the trials, at steps that are halved again and again.
class ScoutErrors
{
public:
  explicit ScoutErrors(Trials& trials);

  /// Goes on to shorter steps until the last one is good to `wanted` (m), or halving does not help.
  void refine_to(double wanted);

  /// The motion parts from itself: shorter steps do not bring it nearer to anything.
  bool is_at_its_floor() const;

  const Motion& finest() const;
  double error_of_finest() const;

  /// Estimated at any step (s), m.
  double error_of(double time_step) const;

private:
  void halve();
  double error_at(size_t step) const;

  Trials& trials_;
  std::vector<double> steps_;        ///< s
  std::vector<double> differences_;  ///< of the motions at a step and the next one, m
};

}  // namespace cloth
