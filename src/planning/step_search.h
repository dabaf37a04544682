#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cloth_sim/methods/spectrum.h"

#include "scout_errors.h"
#include "step_costs.h"
#include "trials.h"

namespace cloth
{

/// A method and its step.
struct Candidate
{
  const MethodRow* row;
  Stepping stepping;  ///< of the scene itself; time_step 0: as stability allows
  double time_step;   ///< s
};

/// What a candidate would err by on the scene itself.
class CandidateErrors
{
public:
  CandidateErrors(Trials& trials, const ScoutErrors& scout_errors, double grid_allowance);

  /// Estimated by a trial, m.
  double error_of(const Candidate& candidate);

  /// Whether a longer step of the same method errs by so much that this one cannot come below `allowed` (m).
  bool is_hopeless(const Candidate& candidate, double allowed) const;

private:
  struct Known
  {
    const MethodRow* row;
    double time_step;
    double error;
  };

  double on_the_coarser_grid(const Candidate& candidate);

  Trials& trials_;
  const ScoutErrors& scout_errors_;
  double grid_allowance_;
  std::vector<Known> known_;
};

/// Finds the cheapest candidate that errs by `allowed` (m) at most, or what comes nearest to it in real time.
class StepSearch
{
public:
  StepSearch(const StartedScene& scene, Trials& trials, double allowed, StepCosts& costs);

  void run();

  /// None: no method has a stable step.
  const std::optional<Candidate>& best() const
  {
    return best_;
  }
  double error() const
  {
    return error_;
  }
  double cost() const
  {
    return cost_;
  }
  /// Why it is the best, with numbers.
  std::string reason(double tolerance) const;

private:
  void search_scout();
  void search(const MethodRow& row);
  void take(const Candidate& candidate, double error, double cost);

  const StartedScene& scene_;
  Trials& trials_;
  double allowed_;
  StepCosts& costs_;
  double grid_allowance_;
  ScoutErrors scout_errors_;
  CandidateErrors errors_;
  Spectrum spectrum_;
  double evaluation_;  ///< s of work of a step of the scout
  std::optional<Candidate> best_;
  double error_ = std::numeric_limits<double>::infinity();
  double cost_ = std::numeric_limits<double>::infinity();
  std::string cheaper_;  ///< in words the step before it, which is not exact enough
  std::string dearer_;   ///< in words the next step, which takes too long
};

/// As many digits as an estimate is good for.
std::string in_two_digits(double number);

}  // namespace cloth
