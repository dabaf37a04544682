#pragma once

#include <limits>
#include <vector>

#include "trials.h"

namespace cloth
{

/// How exact a method is on the grid of the trials, at steps that are halved again and again.
class MethodErrors
{
public:
  /// What other runs are held against.
  struct Reference
  {
    const Motion* motion = nullptr;
    double error = std::numeric_limits<double>::infinity();  ///< of itself, estimated, m
  };

  /// `stepping` is the one with the longest step (s).
  MethodErrors(Trials& trials, int order, const Stepping& stepping);

  /// From now on the error of every run is its distance from the reference. Without one it follows from how the runs
  /// differ among each other.
  void hold_against(const Reference& reference);
  bool has_reference() const
  {
    return reference_.motion != nullptr;
  }

  /// Runs the longest step first, then half the step before.
  void run_next();

  /// Whether there is an error at any step: two runs without a reference, one with it.
  bool is_known() const;

  /// Whether the error at the longest step but one is more than a guess from a single difference.
  bool has_two() const
  {
    return has_reference() || differences_.size() > 1;
  }

  /// Whether the errors fall as they do where steps are short enough for the method's order to show.
  bool falls() const;

  /// Runs with shorter steps do not differ less: the motion parts from itself, or all steps are far too long.
  bool is_at_its_floor() const;

  double finest_step() const
  {
    return steps_.back();
  }
  const Motion& finest() const;
  double error_of_finest() const;

  /// Estimated at any step (s), m; a straight line in logarithms.
  double error_of(double time_step) const;

  /// The longest step, s, no longer than the longest one run, whose error is `allowed` (m); below the shortest one run
  /// as errors fall between the last two.
  double step_for(double allowed) const;

private:
  Stepping at(double time_step) const;
  double error_at(size_t run) const;
  /// Of the line through the last two errors that say something about `time_step`.
  double slope(size_t next) const;

  Trials& trials_;
  int order_;
  Stepping stepping_;
  Reference reference_;
  std::vector<double> steps_;        ///< s
  std::vector<double> differences_;  ///< m; of a run from the reference, or from the run at half its step
};

}  // namespace cloth
