#include "planned_run.h"

#include <chrono>

#include "own_solver.h"
#include "yardstick.h"

namespace cloth
{

TimedPlan timed_plan(SceneParams scene, double tolerance)
{
  using Clock = std::chrono::steady_clock;
  scene.solver.tolerance = tolerance;
  const double before = Yardstick::shared().length();
  const Clock::time_point begin = Clock::now();
  TimedPlan result{ make_plan(scene), 0.0, 0.0 };
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
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
