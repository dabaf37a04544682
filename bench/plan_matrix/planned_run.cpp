#include "planned_run.h"

#include "cloth_sim/threads/processor.h"

#include "own_solver.h"
#include "yardstick.h"

namespace cloth
{

TimedPlan timed_plan(SceneParams scene, double tolerance)
{
  scene.solver.tolerance = tolerance;
  const double before = Yardstick::shared().length();
  const double begin = processor_seconds();
  TimedPlan result{ make_plan(scene), 0.0, 0.0 };
  result.seconds = processor_seconds() - begin;
  result.yardsticks = result.seconds / (0.5 * (before + Yardstick::shared().length()));
  return result;
}

Outcome run_of(const Plan& plan, const Problem& problem, double most_seconds)
{
  Simulation simulation = build_simulation(plan);
  return outcome_of(simulation, problem, most_seconds);
}

PartNames left_out(const Plan& plan)
{
  return PartNames(plan.choice.left_out.begin(), plan.choice.left_out.end());
}

}  // namespace cloth
