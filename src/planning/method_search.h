#pragma once

#include <memory>
#include <optional>

#include "cloth_sim/methods/spectrum.h"

#include "method_errors.h"
#include "step_costs.h"
#include "trials.h"

namespace cloth
{

/// Errors that differ by less than this factor are the same.
constexpr double level_errors = 1.25;

/// A reference errs by no more than this part of what may be erred by.
constexpr double reference_share = 0.25;

/// A method and its steps.
struct Candidate
{
  const MethodRow* row;
  Stepping stepping;        ///< of the scene itself; time_step 0: as stability allows
  double time_step;         ///< s; of a method that chooses its steps, their mean
  double error;             ///< estimated, m
  double cost;              ///< s of work for a simulated second
  Stepping on_trials;       ///< the same on the coarser grid, with steps as long as that allows
  double stretch;           ///< how much longer a step there does the same
  double longest;           ///< time_step as it was found, s: a check may shorten it
  double longest_of_all;    ///< of the method's steps on the scene itself, s
  bool is_checked = false;  ///< on the sheet itself
};

/// What steps may err by, m.
struct Allowance
{
  double estimated;  ///< where that follows from how runs differ, or from a coarser grid
  double measured;   ///< where it is how far they are from a far more exact motion of the sheet itself, all along
};

/// What all searches of a scene share.
struct SearchedScene
{
  const StartedScene& scene;
  Allowance allowed;
  Trials& trials;
  StepCosts& costs;
};

/// Looks for the cheapest steps of one method that are exact enough, a trial at a time and the cheapest trials first.
class MethodSearch
{
public:
  virtual ~MethodSearch() = default;

  /// Nothing more can come of it.
  virtual bool is_over() const = 0;

  /// s of work for a simulated second: what is found by the next trial will hardly cost less.
  virtual double least_cost() const = 0;

  /// Of the next trial, s of work.
  virtual double trial_cost() const = 0;

  /// Of the step that the next trial is about, s of work for a simulated second.
  virtual double next_cost() const = 0;

  /// Held against a reference where there is a motion.
  virtual void try_next(const MethodErrors::Reference& reference) = 0;

  /// From now on errors are distances from the reference.
  virtual void hold_against(const MethodErrors::Reference& reference) = 0;

  /// The cheapest steps that are exact enough.
  virtual std::optional<Candidate> found() const = 0;

  /// The most exact of the steps that cost no more than so much, or longer ones that err by hardly more, by this factor
  /// at most.
  virtual std::optional<Candidate> nearest(double most_cost, double hardly_more) const = 0;

  /// Its most exact run so far.
  virtual MethodErrors::Reference reference() const = 0;

  /// What its longest steps err by, m; infinite: that is not known.
  virtual double error_of_longest() const = 0;

  /// Whether it is known how errors fall when steps are halved, and whether they do: where not, the motion parts from
  /// itself, or all steps so far are far too long, which a reference tells.
  virtual bool knows_its_floor() const
  {
    return false;
  }
  virtual bool is_at_its_floor() const
  {
    return false;
  }
};

/// None: no step of the method is stable, or even the first would take too long to find out.
std::unique_ptr<MethodSearch> search_of(const MethodRow& row, const SearchedScene& searched);

}  // namespace cloth
