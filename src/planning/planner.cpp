#include "planner.h"

#include <algorithm>
#include <cmath>

#include "cloth_sim/scene/scene_reader.h"

#include "model_parts.h"
#include "step_search.h"
#include "trials.h"

namespace cloth
{
namespace
{

/// Parts are left out where that changes the answer by less than this part of the tolerance.
constexpr double trial_share = 0.25;
/// Method and step may err by this part of it.
constexpr double step_share = 0.5;

struct LeftOut
{
  std::vector<std::string> parts;
  double change = 0.0;  ///< of the answer without all of them, m
};

/// What changes the answer least goes first; what is left out stays within its share together with the rest.
LeftOut parts_to_leave_out(Trials& trials, const Candidate& best, double allowed, std::vector<TriedPart>& tried)
{
  Stepping on_scene = best.stepping;
  on_scene.time_step = best.row->is_adaptive ? on_scene.time_step : best.time_step;
  const double enough = trials.scene().params.solver.tolerance;
  const auto change_without = [&](const std::vector<std::string>& parts) {
    const double change = trials.change_without(parts, best.on_trials, enough);
    const bool lets_short_waves_grow = std::find(parts.begin(), parts.end(), internal_damping) != parts.end();
    return change < allowed && lets_short_waves_grow ? trials.change_on_the_sheet(parts, on_scene, change, enough) :
                                                       change;
  };
  for (const ModelPart& part : optional_parts())
  {
    if (part.is_there(trials.scene().params))
    {
      tried.push_back({ part.name, change_without({ part.name }) });
    }
  }
  std::vector<TriedPart> by_change = tried;
  std::stable_sort(by_change.begin(), by_change.end(),
                   [](const TriedPart& one, const TriedPart& other) { return one.change < other.change; });
  LeftOut left_out;
  for (const TriedPart& part : by_change)
  {
    std::vector<std::string> parts = left_out.parts;
    parts.push_back(part.part);
    const double change = left_out.parts.empty() ? part.change : change_without(parts);
    if (!(part.change < allowed) || !(change < allowed))
    {
      break;
    }
    left_out = { parts, change };
  }
  return left_out;
}

}  // namespace

Planned plan_by_trial(const StartedScene& scene, StepCosts& costs)
{
  const double tolerance = scene.params.solver.tolerance;
  Trials trials(scene, costs);
  StepSearch search(scene, trials, step_share * tolerance, costs);
  search.run();
  if (!search.best())
  {
    throw SceneError("solver.method: auto, but no method has a stable step for this scene");
  }
  Planned result;
  LeftOut left_out;
  if (scene.params.plan == "auto")
  {
    const bool can_tell = search.best()->error <= tolerance;
    left_out = parts_to_leave_out(trials, *search.best(), can_tell ? trial_share * tolerance : 0.0, result.tried);
  }
  const Stepping& stepping = search.best()->stepping;
  const double method_tolerance = search.best()->row->is_adaptive ? stepping.tolerance : tolerance;
  result.choice = { left_out.parts,     stepping.method,     stepping.time_step,
                    method_tolerance,   stepping.iterations, std::hypot(search.best()->error, left_out.change),
                    search.best()->cost };
  result.reason = search.reason(tolerance);
  return result;
}

}  // namespace cloth
