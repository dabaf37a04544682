#include "planner.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cloth_sim/scene/scene_reader.h"

#include "model_parts.h"
#include "step_search.h"
#include "trials.h"

namespace cloth
{
namespace
{

/// Of the tolerance: what method and step may err by, where their errors are estimated and where they are measured;
/// these with what the model errs by for want of what is left out are not above it.
constexpr double estimated_share = 0.5;
constexpr double measured_share = 0.85;

/// What is left out, and the cheapest steps without it. None: no method has a stable step.
struct Found
{
  LeftOut left_out;
  std::optional<Candidate> best;
  std::string reason;
};

Found search_steps(const StartedScene& scene, Trials& trials, StepCosts& costs, const LeftOut& left_out)
{
  const double tolerance = scene.params.solver.tolerance;
  const double measured = std::min(measured_share * tolerance, tolerance - left_out.change);
  StepSearch search(scene, trials, { estimated_share * tolerance, measured }, costs);
  search.run();
  return { left_out, search.best(), search.best() ? search.reason(tolerance) : "" };
}

Probe probe_by(const Candidate& best)
{
  Stepping on_scene = best.stepping;
  on_scene.time_step = best.row->is_adaptive ? on_scene.time_step : best.time_step;
  return { best.on_trials, on_scene };
}

/// Without the parts that the scout says may go, where the tolerance can be had: what is below the error of steps
/// cannot be seen.
std::optional<Found> search_without_parts(const StartedScene& scene, Trials& trials, StepCosts& costs,
                                          std::vector<TriedPart>& tried)
{
  const LeftOut left_out = parts_to_leave_out(trials, scouts(trials), true, tried);
  if (left_out.parts.empty())
  {
    return std::nullopt;
  }
  StartedScene lesser = scene;
  lesser.params = without(scene.params, left_out.parts);
  Trials lesser_trials(lesser, costs, trials.seconds());
  Found found = search_steps(lesser, lesser_trials, costs, left_out);
  return found.best && found.best->error <= scene.params.solver.tolerance ? std::optional<Found>(found) : std::nullopt;
}

/// Parts are tried first, by the scout, since a model without them may have other steps; by the steps that were found,
/// where the scout takes too long.
Found search_all(const StartedScene& scene, StepCosts& costs, std::vector<TriedPart>& tried)
{
  Trials trials(scene, costs);
  const bool tries_parts = scene.params.plan == "auto";
  const bool tries_parts_first = tries_parts && can_afford_scouts(trials);
  if (tries_parts_first)
  {
    if (const std::optional<Found> found = search_without_parts(scene, trials, costs, tried))
    {
      return *found;
    }
  }
  Found found = search_steps(scene, trials, costs, {});
  if (found.best && tries_parts && !tries_parts_first)
  {
    const bool can_tell = found.best->error <= scene.params.solver.tolerance;
    found.left_out = parts_to_leave_out(trials, probe_by(*found.best), can_tell, tried);
  }
  return found;
}

}  // namespace

Planned plan_by_trial(const StartedScene& scene, StepCosts& costs)
{
  Planned result;
  const Found found = search_all(scene, costs, result.tried);
  if (!found.best)
  {
    throw SceneError("solver.method: auto, but no method has a stable step for this scene");
  }
  const Stepping& stepping = found.best->stepping;
  const double tolerance = found.best->row->is_adaptive ? stepping.tolerance : scene.params.solver.tolerance;
  result.choice = { found.left_out.parts, stepping.method,
                    stepping.time_step,   tolerance,
                    stepping.iterations,  std::hypot(found.best->error, found.left_out.change),
                    found.best->cost };
  result.reason = found.reason;
  return result;
}

}  // namespace cloth
