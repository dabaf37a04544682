#include "step_search.h"

#include <algorithm>
#include <cmath>

#include "cloth_sim/scene/yaml_text.h"

namespace cloth
{
namespace
{

/// The longest step of a method that is stable at any, s.
constexpr double longest_step = 1.0 / 30.0;
constexpr int halvings = 10;
constexpr int halvings_within_limit = 3;
/// Where the time of a step depends on its length: it is never so small a part of that at the middle step.
constexpr double least_part = 0.5;
/// Solves of larger sheets take too long to be measured; s.
constexpr double longest_evaluation = 1e-3;
/// A dearer method is not worth a change.
constexpr double level = 0.9;
/// The part of real time that steps may take: a node makes and publishes messages besides.
constexpr double real_time_share = 0.5;
/// What the reference of all candidates may err by, in parts of what they may.
constexpr double reference_share = 0.5;

Stepping stepping_of(const MethodRow& row, double time_step, const SceneParams& scene)
{
  Stepping stepping{ row.name, time_step };
  const bool is_in_substeps = row.iterates_locally && row.linear_solves == 0;
  stepping.iterations = is_in_substeps ? 1 : scene.solver.iterations;
  return stepping;
}

/// The steps of a method that are worth a trial, the longest first. An explicit one's first is as long as stability
/// allows at any moment.
std::vector<Candidate> candidates_of(const MethodRow& row, const StartedScene& scene, const Spectrum& spectrum)
{
  const double limit = network_stability_limit(row, spectrum);
  const bool is_limited = std::isfinite(limit);
  double time_step = is_limited ? Simulation::limit_share * limit : longest_step;
  const double given = scene.params.solver.time_step;
  std::vector<Candidate> candidates;
  for (int k = 0; k <= (is_limited ? halvings_within_limit : halvings); ++k, time_step *= 0.5)
  {
    if (time_step >= Simulation::shortest_step && (given == 0.0 || time_step <= given))
    {
      const double as_limited = is_limited && k == 0 ? 0.0 : time_step;
      candidates.push_back({ &row, stepping_of(row, as_limited, scene.params), time_step });
    }
  }
  if (candidates.empty() && given > 0.0)
  {
    candidates.push_back({ &row, stepping_of(row, given, scene.params), given });
  }
  return candidates;
}

std::string in_words(const Candidate& candidate, double error, double cost)
{
  return std::string(candidate.row->name) + " at steps of " + in_two_digits(candidate.time_step) + " s errs by " +
         in_two_digits(error) + " m over " + format_number(Motion::horizon) + " s for " + in_two_digits(cost) +
         " s of work a second";
}

}  // namespace

std::string in_two_digits(double number)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", number);
  return text;
}

CandidateErrors::CandidateErrors(Trials& trials, const ScoutErrors& scout_errors, double grid_allowance)
  : trials_(trials), scout_errors_(scout_errors), grid_allowance_(grid_allowance)
{
}

double CandidateErrors::error_of(const Candidate& candidate)
{
  const double error = grid_allowance_ * on_the_coarser_grid(candidate);
  known_.push_back({ candidate.row, candidate.time_step, error });
  return error;
}

bool CandidateErrors::is_hopeless(const Candidate& candidate, double allowed) const
{
  return std::any_of(known_.begin(), known_.end(), [&](const Known& known) {
    const int most_order = candidate.row->order + 1;
    return known.row == candidate.row && candidate.time_step < known.time_step &&
           known.error * std::pow(candidate.time_step / known.time_step, most_order) > allowed;
  });
}

double CandidateErrors::on_the_coarser_grid(const Candidate& candidate)
{
  if (candidate.row->name == std::string(scout))
  {
    return scout_errors_.error_of(candidate.time_step);
  }
  Stepping stepping = candidate.stepping;
  stepping.time_step = candidate.time_step * (candidate.row->iterates_locally ? trials_.coarseness() : 1.0);
  return std::hypot(distance(trials_.motion(stepping), scout_errors_.finest()), scout_errors_.error_of_finest());
}

StepSearch::StepSearch(const StartedScene& scene, Trials& trials, double allowed, StepCosts& costs)
  : scene_(scene)
  , trials_(trials)
  , allowed_(allowed)
  , costs_(costs)
  , grid_allowance_(trials.grid_allowance())
  , scout_errors_(trials)
  , errors_(trials, scout_errors_, grid_allowance_)
  , evaluation_(costs.of_a_step(scene, { scout }))
{
  const Simulation simulation = simulation_of(scene, { scout });
  spectrum_ = spectrum_of(simulation.dynamics(), simulation.state().positions);
}

void StepSearch::run()
{
  scout_errors_.refine_to(reference_share * allowed_ / grid_allowance_);
  search_scout();
  for (const MethodRow& row : methods())
  {
    if (row.name != std::string(scout) && !row.is_adaptive)
    {
      search(row);
    }
  }
}

/// What is tried already says how exact it is at any step.
void StepSearch::search_scout()
{
  for (const Candidate& candidate : candidates_of(*find_method(scout), scene_, spectrum_))
  {
    const double error = errors_.error_of(candidate);
    const double cost = evaluation_ / candidate.time_step;
    if (best_ && cost > real_time_share)
    {
      dearer_ = in_words(candidate, error, cost);
      break;
    }
    if (best_)
    {
      cheaper_ = in_words(*best_, error_, cost_);
    }
    take(candidate, error, cost);
    if (error <= allowed_ || scout_errors_.is_at_its_floor())
    {
      break;
    }
  }
}

void StepSearch::search(const MethodRow& row)
{
  const std::vector<Candidate> candidates = candidates_of(row, scene_, spectrum_);
  const bool takes_too_long_to_measure = row.linear_solves > 0 && evaluation_ > longest_evaluation;
  if (candidates.empty() || takes_too_long_to_measure)
  {
    return;
  }
  const bool costs_depend_on_step = row.linear_solves > 0;
  const double typical_seconds = costs_.of_a_step(scene_, candidates[candidates.size() / 2].stepping);
  const double least_seconds = typical_seconds * (costs_depend_on_step ? least_part : 1.0);
  for (const Candidate& candidate : candidates)
  {
    const bool is_met = error_ <= allowed_;
    if ((is_met && least_seconds / candidate.time_step > level * cost_) || trials_.are_over())
    {
      break;
    }
    if (errors_.is_hopeless(candidate, allowed_))
    {
      continue;
    }
    const double error = errors_.error_of(candidate);
    if (error > allowed_)
    {
      continue;
    }
    const double seconds = costs_depend_on_step ? costs_.of_a_step(scene_, candidate.stepping) : typical_seconds;
    const double cost = seconds / candidate.time_step;
    if (cost < level * cost_ || (!is_met && cost <= real_time_share))
    {
      take(candidate, error, cost);
    }
    break;
  }
}

void StepSearch::take(const Candidate& candidate, double error, double cost)
{
  best_ = candidate;
  error_ = error;
  cost_ = cost;
}

std::string StepSearch::reason(double tolerance) const
{
  std::string words = in_words(*best_, error_, cost_);
  if (error_ > tolerance)
  {
    words += "; the tolerance of " + format_number(tolerance) + " m cannot be had";
    if (scout_errors_.is_at_its_floor())
    {
      return words + ", since the motion parts from itself: shorter steps bring it nearer to nothing";
    }
    return words + (dearer_.empty() ? "" : " in real time: " + dearer_);
  }
  words += cost_ > 1.0 ? ", slower than real time" : "";
  return words + (cheaper_.empty() ? "" : "; cheaper: " + cheaper_);
}

}  // namespace cloth
