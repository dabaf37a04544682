#include "trials.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cloth_sim/scene/scene_reader.h"
#include "cloth_sim/scene/yaml_text.h"

namespace cloth
{
namespace
{

constexpr int fewest_nodes = 8;
constexpr int most_factor = 16;
/// What all trials may take, s of work, about, those of the sheet itself and of coarser ones; and how many there are,
/// in runs of the scout at its longest step.
constexpr double most_seconds_of_the_sheet = 0.3;
constexpr double most_seconds = 3.0;
constexpr double expected_trials = 12.0;

/// How much shorter steps may be than those of first order.
constexpr double much_shorter = 1.5;

/// A run that takes this many times what steps of its length take leads to nothing; neither does one that solves
/// equations where it takes longer than a part of the scout's, or one that chooses its steps where it takes much
/// longer.
constexpr double most_of_own = 40.0;
constexpr double most_of_scout = 0.25;
constexpr double evaluations_of_a_first_solve = 5000.0;
constexpr double most_of_scout_by_tolerance = 50.0;

/// By how much the errors of a sheet may differ from those of the coarser one of a trial, and what is taken where to
/// find out takes too long.
constexpr double least_allowance_of_local_iterations = 1.5;
constexpr double most_seconds_on_the_sheet = 1.0;
constexpr double most_seconds_of_a_cheap_check = 0.4;
constexpr double most_seconds_of_the_scout = 0.3;
constexpr double most_seconds_of_a_change = 0.5;
constexpr double most_seconds_of_changes = 0.7;

/// What passes of the strain limit that are too few for a step may leave of a strain, relative to the limit, whatever
/// the scout's steps leave, and how many times what those leave, in which luck has a part.
constexpr double tolerated_excess = 0.1;
constexpr double excess_of_luck = 1.5;

const char* const first_order = "symplectic_euler";
const char* const second_order = "velocity_verlet";

double nodes_of(const StartedScene& scene)
{
  return static_cast<double>(scene.start.state.positions.rows());
}

std::string key_of(const Stepping& stepping, const PartList& left_out)
{
  std::string key = stepping.method + " " + format_number(stepping.time_step) + " " +
                    format_number(stepping.tolerance) + " " + std::to_string(stepping.iterations);
  for (const std::string& part : left_out)
  {
    key += " without " + part;
  }
  return key;
}

double weight_of_evaluations(const MethodRow& row)
{
  return row.iterates_locally && row.linear_solves == 0 ? evaluations_of_a_pass : 1.0;
}

StartedScene scene_without(StartedScene scene, const PartList& parts)
{
  scene.params = without(scene.params, parts);
  return scene;
}

int coarsening_of(const StartedScene& scene, double seconds_a_run)
{
  const double of_the_sheet = expected_trials * seconds_a_run;
  const bool is_small = std::min(scene.params.sheet.rows, scene.params.sheet.cols) <= fewest_nodes;
  if (is_small || of_the_sheet <= most_seconds_of_the_sheet)
  {
    return 1;
  }
  int factor = 2;
  for (double seconds = of_the_sheet / 8.0; seconds > most_seconds && factor < most_factor; seconds /= 8.0)
  {
    factor *= 2;
  }
  return factor;
}

Spectrum spectrum_at_the_start(const StartedScene& scene)
{
  const Simulation simulation = simulation_of(scene, { second_order });
  return spectrum_of(simulation.dynamics(), simulation.state().positions);
}

const MethodRow& scout_for(const Spectrum& spectrum)
{
  const MethodRow& first = *find_method(first_order);
  const MethodRow& second = *find_method(second_order);
  return cloth::likely_limit(first, spectrum) > much_shorter * cloth::likely_limit(second, spectrum) ? first : second;
}

/// The sheet itself where pins that are apart would come to hold the same node.
StartedScene pilot_of(const StartedScene& scene, int factor)
{
  StartedScene pilot = coarser(scene, factor, fewest_nodes);
  try
  {
    simulation_of(pilot, { second_order });
  }
  catch (const SceneError&)
  {
    return scene;
  }
  return pilot;
}

}  // namespace

Trials::Trials(const StartedScene& scene, StepCosts& costs, double seconds_before)
  : scene_(scene)
  , spectrum_of_the_sheet_(spectrum_at_the_start(scene))
  , scout_(scout_for(spectrum_of_the_sheet_))
  , evaluation_(costs.of_an_evaluation(scene, { second_order }))
  , seconds_(seconds_before)
{
  const double step = Simulation::limit_share * network_stability_limit(scout_, spectrum_of_the_sheet_);
  pilot_ = pilot_of(scene, coarsening_of(scene, Motion::horizon / step * evaluation_));
  spectrum_ = is_coarser() ? spectrum_at_the_start(pilot_) : spectrum_of_the_sheet_;
  scout_step_ = Simulation::limit_share * limit(scout_);
}

const MethodRow& Trials::scout_of_second_order()
{
  return *find_method(second_order);
}

bool Trials::is_coarser() const
{
  return nodes_of(pilot_) < nodes_of(scene_);
}

double Trials::limit(const MethodRow& row) const
{
  return network_stability_limit(row, spectrum_);
}

double Trials::likely_limit(const MethodRow& row) const
{
  return cloth::likely_limit(row, spectrum_);
}

bool Trials::can_afford_a_first_solve() const
{
  return evaluations_of_a_first_solve < most_of_scout * Motion::horizon / scout_step_;
}

double Trials::seconds_of_a_run(double time_step, double evaluations_a_step) const
{
  return Motion::horizon / time_step * evaluations_a_step * evaluation_ * nodes_of(pilot_) / nodes_of(scene_);
}

double Trials::coarseness() const
{
  const SheetProperties& fine = scene_.params.sheet;
  const SheetProperties& coarse = pilot_.params.sheet;
  const auto ratio = [](int cells, int coarse_cells) {
    return coarse_cells > 0 ? static_cast<double>(cells) / coarse_cells : 1.0;
  };
  return std::max(ratio(fine.rows - 1, coarse.rows - 1), ratio(fine.cols - 1, coarse.cols - 1));
}

std::optional<double> Trials::early_factor(const Stepping& stepping, const Stepping& on_trial)
{
  if (seconds_of_a_check(stepping) * early_samples / Motion::samples > most_seconds_on_the_sheet)
  {
    return std::nullopt;
  }
  Motions early_motions;
  const double ratio = difference_of_shorter(scene_, stepping, early_samples, motions_of_the_sheet_) /
                       difference_of_shorter(pilot_, on_trial, early_samples, early_motions);
  const double least = find_method(stepping.method)->iterates_locally ? least_allowance_of_local_iterations : 1.0;
  return std::isfinite(ratio) ? std::clamp(ratio, least, most_allowance) : most_allowance;
}

std::optional<double> Trials::difference_on_the_sheet(const Stepping& stepping)
{
  if (seconds_of_a_check(stepping) > most_seconds_on_the_sheet)
  {
    return std::nullopt;
  }
  return difference_of_shorter(scene_, stepping, Motion::samples, motions_of_the_sheet_);
}

double Trials::difference_on_trials(const Stepping& on_trials)
{
  return difference_of_shorter(pilot_, on_trials, Motion::samples, motions_);
}

double Trials::difference_of_shorter(const StartedScene& scene, const Stepping& stepping, int samples, Motions& motions)
{
  Stepping shorter = stepping;
  shorter.time_step /= shorter_in_a_check;
  return distance(known_or_run(scene, {}, stepping, samples, motions),
                  known_or_run(scene, {}, shorter, samples, motions), samples);
}

bool Trials::can_afford_a_whole_check(const Stepping& stepping) const
{
  return seconds_of_a_check(stepping) < most_seconds_of_a_cheap_check;
}

double Trials::error_on_the_sheet(const Stepping& stepping)
{
  const Motion& exact =
      known_or_run(scene_, {}, longest_of_scout_on_the_sheet(), Motion::samples, motions_of_the_sheet_);
  return distance(known_or_run(scene_, {}, stepping, Motion::samples, motions_of_the_sheet_), exact);
}

bool Trials::can_afford_the_scout_on_the_sheet() const
{
  const double seconds = Motion::horizon / longest_of_scout_on_the_sheet().time_step * evaluation_;
  return is_coarser() && seconds < most_seconds_of_the_scout;
}

double Trials::travel(const Motion& motion) const
{
  Motion at_rest = motion;
  std::fill(at_rest.positions.begin(), at_rest.positions.end(), pilot_.start.state.positions);
  return distance(motion, at_rest, static_cast<int>(motion.positions.size()));
}

double Trials::change(const PartList& parts, const PartList& more, const Stepping& stepping, double enough)
{
  return change_between(parts, more, stepping, enough, pilot_, motions_);
}

double Trials::change_on_the_sheet(const PartList& parts, const PartList& more, const Probe& probe, double on_trials,
                                   double enough)
{
  if (!is_coarser())
  {
    return on_trials;
  }
  const double seconds = 2.0 * Motion::horizon / probe.on_scene.time_step * evaluation_;
  if (seconds < most_seconds_of_a_change)
  {
    return change_between(parts, more, probe.on_scene, enough, scene_, motions_of_the_sheet_);
  }
  if (seconds_ + seconds * early_samples / Motion::samples > most_seconds_of_changes)
  {
    return untried_allowance * on_trials;
  }
  const auto early_change = [&](const StartedScene& scene, const Stepping& stepping, Motions& motions) {
    return distance(known_or_run(scene, parts, stepping, early_samples, motions),
                    known_or_run(scene, more, stepping, early_samples, motions), early_samples);
  };
  const double factor =
      early_change(scene_, probe.on_scene, motions_of_the_sheet_) / early_change(pilot_, probe.on_trials, motions_);
  return on_trials *
         (std::isfinite(factor) ? std::clamp(factor, 1.0 / most_allowance, most_allowance) : most_allowance);
}

double Trials::change_between(const PartList& parts, const PartList& more, const Stepping& stepping, double enough,
                              const StartedScene& scene, Motions& motions)
{
  const Motion& whole = known_or_run(scene, parts, stepping, Motion::samples, motions);
  const auto is_enough = [&](const Motion& so_far) { return least_distance(whole, so_far) > enough; };
  Motion& lesser = motions[key_of(stepping, more)];
  if (lesser.positions.size() < size_t(Motion::samples))
  {
    lesser = run(scene_without(scene, more), stepping, Motion::samples, is_enough);
  }
  return is_enough(lesser) ? least_distance(whole, lesser) : distance(whole, lesser);
}

Stepping Trials::longest_of_scout() const
{
  return { scout_.name, scout_step_ };
}

Stepping Trials::longest_of_scout_on_the_sheet() const
{
  return { scout_.name, Simulation::limit_share * network_stability_limit(scout_, spectrum_of_the_sheet_) };
}

double Trials::seconds_of_a_check(const Stepping& stepping) const
{
  const MethodRow& row = *find_method(stepping.method);
  return (1.0 + shorter_in_a_check) * Motion::horizon / stepping.time_step * row.force_evaluations *
         weight_of_evaluations(row) * evaluation_;
}

const Motion& Trials::motion(const Stepping& stepping)
{
  const std::string key = key_of(stepping, {});
  const auto known = motions_.find(key);
  return known != motions_.end() ? known->second : motions_.emplace(key, run(pilot_, stepping)).first->second;
}

const Motion& Trials::known_or_run(const StartedScene& scene, const PartList& left_out, const Stepping& stepping,
                                   int samples, Motions& motions)
{
  Motion& motion = motions[key_of(stepping, left_out)];
  if (static_cast<int>(motion.positions.size()) < samples)
  {
    motion = run(scene_without(scene, left_out), stepping, samples);
  }
  return motion;
}

Motion Trials::run(const StartedScene& scene, const Stepping& stepping, int samples, const IsEnough& is_enough)
{
  const MethodRow& row = *find_method(stepping.method);
  const double of_scout = Motion::horizon / scout_step_;
  const double most = row.is_adaptive ? most_of_scout_by_tolerance * of_scout :
                      row.linear_solves > 0 ?
                                        most_of_scout * of_scout :
                                        most_of_own * row.force_evaluations * Motion::horizon / stepping.time_step;
  Motion motion = counted_motion(scene, stepping, most, samples, is_enough);
  const auto solves = static_cast<double>(motion.counters.steps) * row.linear_solves;
  if (evaluations_of_a_solve_ == 0.0 && solves > 0.0 && !row.iterates_locally)
  {
    evaluations_of_a_solve_ = evaluations_in(motion.counters) / solves;
  }
  const bool may_be_too_long = std::isinf(likely_limit(row));
  if (may_be_too_long && motion.excess > tolerated_excess && motion.excess > most_excess())
  {
    motion.positions.clear();
  }
  return motion;
}

Motion Trials::counted_motion(const StartedScene& scene, const Stepping& stepping, double most_evaluations, int samples,
                              const IsEnough& is_enough)
{
  Motion motion = motion_of(scene, stepping, most_evaluations, samples, is_enough);
  seconds_ += evaluations_in(motion.counters) * weight_of_evaluations(*find_method(stepping.method)) * evaluation_ *
              nodes_of(scene) / nodes_of(scene_);
  return motion;
}

double Trials::most_excess()
{
  if (!most_excess_)
  {
    const double of_scout =
        counted_motion(pilot_, longest_of_scout(), std::numeric_limits<double>::infinity(), Motion::samples).excess;
    most_excess_ = excess_of_luck * of_scout;
  }
  return *most_excess_;
}

}  // namespace cloth
