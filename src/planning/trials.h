#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cloth_sim/methods/spectrum.h"

#include "model_parts.h"
#include "pilot.h"
#include "started_scene.h"
#include "step_costs.h"

namespace cloth
{

/// How many samples are enough to compare a sheet with a coarser one.
constexpr int early_samples = 2;
/// What is taken for a sheet's factor where to find out takes too long.
constexpr double untried_allowance = 3.0;
/// By how much the errors of a sheet may differ from those of a coarser one.
constexpr double most_allowance = 30.0;
/// What a pass over the springs takes that handles them one after the other, in evaluations of the forces.
constexpr double evaluations_of_a_pass = 3.0;
/// A check compares steps with some that are shorter by this factor.
constexpr double shorter_in_a_check = 2.0;

/// The steps that parts are tried by.
struct Probe
{
  Stepping on_trials;  ///< on the coarser grid
  Stepping on_scene;   ///< on the sheet itself
};

/// All trial runs of a scene, on a coarser grid where that is cheaper.
class Trials
{
public:
  /// Trials of another model may have taken some time before, s of work. Throws SceneError where the scene cannot be
  /// stepped.
  Trials(const StartedScene& scene, StepCosts& costs, double seconds_before = 0.0);

  /// The method that others are held against: of second order, and as cheap as any explicit one, unless the springs'
  /// damping makes its steps much shorter than those of the cheapest of first order.
  const MethodRow& scout() const
  {
    return scout_;
  }

  /// The one of second order.
  static const MethodRow& scout_of_second_order();

  /// Of the sheet itself, at the start.
  const Spectrum& spectrum_of_the_sheet() const
  {
    return spectrum_of_the_sheet_;
  }

  /// Whether they are not on the sheet itself.
  bool is_coarser() const;

  /// How much longer the cells are than the scene's.
  double coarseness() const;

  /// The stability limit of a method on the coarser grid, s, and what it is likely to be.
  double limit(const MethodRow& row) const;
  double likely_limit(const MethodRow& row) const;

  /// What it took to solve a step's equations in the first run that had to, in evaluations of the forces; 0: none had
  /// to.
  double evaluations_of_a_solve() const
  {
    return evaluations_of_a_solve_;
  }

  /// Whether there is time for a first step that solves equations, which takes far more than later ones.
  bool can_afford_a_first_solve() const;

  /// Of a run with steps of this length, s of work: those of as many evaluations of the forces.
  double seconds_of_a_run(double time_step, double evaluations_a_step) const;

  /// The work of all runs so far, s, counted and not timed, so that the same scene is planned alike whatever else the
  /// machine does.
  double seconds() const
  {
    return seconds_;
  }

  /// Of one evaluation of the forces on the scene's own grid, s of work.
  double evaluation() const
  {
    return evaluation_;
  }

  /// By which factor steps err more on the sheet itself, which has more modes to be wrong about, than `on_trial` does
  /// on the coarser grid, as the first quarter of a second has it. None: that takes too long.
  std::optional<double> early_factor(const Stepping& stepping, const Stepping& on_trial);

  /// What shorter steps change on the sheet itself over the whole second, m; infinite where either diverges. None: that
  /// takes too long.
  std::optional<double> difference_on_the_sheet(const Stepping& stepping);

  /// The same on the coarser grid.
  double difference_on_trials(const Stepping& on_trials);

  /// Of a run on the sheet itself and one by shorter steps, s of work, and whether that is little.
  double seconds_of_a_check(const Stepping& stepping) const;
  bool can_afford_a_whole_check(const Stepping& stepping) const;

  /// How far steps are from the scout's longest on the sheet itself over the whole second, m; infinite where either of
  /// them diverges.
  double error_on_the_sheet(const Stepping& stepping);

  /// Whether there is time for the scout on the sheet itself.
  bool can_afford_the_scout_on_the_sheet() const;

  /// How far the nodes move on the coarser grid, m, root mean square.
  double travel(const Motion& motion) const;

  /// By how much the answer by these steps changes where `more` is left out instead of `parts`, m; infinite where that
  /// is what keeps it together. Where that is more than `enough` (m) already some time before the horizon, by how much
  /// at least.
  double change(const PartList& parts, const PartList& more, const Stepping& stepping, double enough);

  /// The same on the sheet itself, which has shorter waves to be changed by it, where it was `on_trials` on the coarser
  /// grid. Where that takes long it follows from how the two compare over the first quarter of a second, and where it
  /// takes too long, some allowance is made.
  double change_on_the_sheet(const PartList& parts, const PartList& more, const Probe& probe, double on_trials,
                             double enough);

  /// The scout's longest steps.
  Stepping longest_of_scout() const;
  Stepping longest_of_scout_on_the_sheet() const;

  /// The motion on the coarser grid. Cut off where it takes many times as long as steps of its length do, and where it
  /// solves equations once it takes a quarter of what the scout's longest steps take; it is none where steps that
  /// stability does not bound leave springs farther above the strain limit than the scout's do.
  const Motion& motion(const Stepping& stepping);

  const StartedScene& scene() const
  {
    return scene_;
  }

private:
  using IsEnough = std::function<bool(const Motion&)>;
  Motion run(const StartedScene& scene, const Stepping& stepping, int samples = Motion::samples,
             const IsEnough& is_enough = {});
  Motion counted_motion(const StartedScene& scene, const Stepping& stepping, double most_evaluations, int samples,
                        const IsEnough& is_enough = {});
  using Motions = std::map<std::string, Motion>;
  /// At least the first so many samples.
  const Motion& known_or_run(const StartedScene& scene, const PartList& left_out, const Stepping& stepping, int samples,
                             Motions& motions);
  double difference_of_shorter(const StartedScene& scene, const Stepping& stepping, int samples, Motions& motions);
  double change_between(const PartList& parts, const PartList& more, const Stepping& stepping, double enough,
                        const StartedScene& scene, Motions& motions);
  double most_excess();

  StartedScene scene_;
  Spectrum spectrum_of_the_sheet_;
  const MethodRow& scout_;
  double evaluation_;
  StartedScene pilot_;
  Spectrum spectrum_;  ///< of the coarser grid
  double scout_step_;  ///< the scout's longest there, s
  double seconds_;
  double evaluations_of_a_solve_ = 0.0;
  std::optional<double> most_excess_;  ///< of strain above its limit, relative to that
  Motions motions_;                    ///< on the coarser grid
  Motions motions_of_the_sheet_;       ///< itself
};

}  // namespace cloth
