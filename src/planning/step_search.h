#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "method_search.h"

namespace cloth
{

/// Finds the cheapest method and steps that err by what is allowed at most, or what comes nearest to that in real time,
/// or in its own time where what real time allows is of no use. Trials that may lead to the cheapest come first, so
/// that finding out costs a part of what it leads to.
class StepSearch
{
public:
  StepSearch(const StartedScene& scene, Trials& trials, const Allowance& allowed, StepCosts& costs);

  void run();

  /// None: no method has a stable step.
  const std::optional<Candidate>& best() const
  {
    return best_;
  }
  /// Why it is the best, with numbers.
  std::string reason(double tolerance) const;

private:
  void find_more();
  MethodSearch* next_search() const;
  MethodSearch* most_promising() const;
  bool is_worth_a_trial(const MethodSearch& search) const;
  bool is_worth(double seconds, double saved_cost) const;
  /// The most exact run of the scout and the methods that were found to be exact enough.
  MethodErrors::Reference most_exact_but(const MethodSearch& asking) const;
  /// The same where it is so exact that others can be held against it while they may be exact enough.
  MethodErrors::Reference reference_for(const MethodSearch& asking) const;
  bool is_cheapest_checked() const;
  void check_cheapest();
  Candidate checked(const Candidate& candidate);
  bool may_be_checked(const Candidate& candidate) const;
  Probe steps_of_a_check(const Candidate& candidate) const;
  Candidate checked_early(Candidate candidate);
  std::optional<Candidate> checked_over_the_second(Candidate candidate);
  Candidate made_exact_enough(Candidate candidate) const;
  bool is_fitted_at_once(const Candidate& candidate) const;
  bool may_be_fitted(const Candidate& candidate) const;
  double error_of_scout_on_the_sheet() const;
  std::optional<Candidate> fitted_on_the_sheet(Candidate candidate) const;
  int order_of(const Candidate& candidate) const;
  void choose();
  bool parts_from_itself() const;
  std::optional<Candidate> parted(std::optional<Candidate> candidate) const;
  std::optional<Candidate> lengthened() const;
  std::optional<Candidate> nearest_in_real_time();
  void approach_in_real_time() const;
  bool is_useless(const Candidate& candidate) const;

  SearchedScene searched_;
  std::vector<std::unique_ptr<MethodSearch>> searches_;
  MethodSearch* scout_of_trials_ = nullptr;
  MethodSearch* scout_ = nullptr;  ///< the same, or that of second order
  MethodSearch* scout_of_second_order_ = nullptr;
  std::vector<Candidate> found_;  ///< the cheapest first
  std::optional<double> factor_;  ///< by which steps err more on the sheet itself, as was checked last
  std::optional<Candidate> best_;
  std::string dearer_;        ///< in words what would be exact enough, and takes too long
  std::string in_real_time_;  ///< in words what comes nearest in real time, where that is of no use
};

/// As many digits as an estimate is good for.
std::string in_two_digits(double number);

}  // namespace cloth
