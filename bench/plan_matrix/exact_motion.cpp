#include "exact_motion.h"

#include <algorithm>
#include <cstdio>

#include "errors.h"
#include "own_solver.h"

namespace cloth
{
namespace
{

constexpr double disturbance = 1e-9;  // m
/// A formula of order 8 of a library takes up to so many times as long as ours of order 5.
constexpr double cost_of_independence = 6.0;
constexpr double coarser = 10.0;
/// What a step leaves grows with the motion: where that comes to so many times what may be left, no check is needed.
constexpr double hopeless = 100.0;

std::string in_short(double number)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", number);
  return text;
}

const OwnSolver& dopri5()
{
  static const OwnSolver solver(*find_method("dopri5"), Setting::tolerance);
  return solver;
}

std::string failure_of(const std::string& solver, const Outcome& outcome)
{
  return solver + " ends as " + name_of(outcome.status);
}

double growth_of(const Problem& problem, const Outcome& base, double tolerance, double most_seconds)
{
  const Outcome moved = dopri5().run(disturbed(problem, disturbance), tolerance, most_seconds);
  double growth = 0.0;
  for (size_t s = 0; s < std::min(base.samples.size(), moved.samples.size()); ++s)
  {
    growth = std::max(growth, rms_distance({ moved.samples[s] }, { base.samples[s] }) / disturbance);
  }
  return growth;
}

struct Check
{
  std::string by;
  double disagreement = 0.0;
  std::string failure;
};

void hold_against(const Outcome& outcome, const std::string& solver, const Outcome& base, Check& check)
{
  if (outcome.status != Status::ok)
  {
    check.failure = failure_of(solver, outcome);
    return;
  }
  check.disagreement = std::max(check.disagreement, rms_distance(outcome.samples, base.samples));
}

Check check_by_itself(const Problem& problem, const Outcome& base, double tolerance, double most_seconds)
{
  const OwnSolver rk4(*find_method("rk4"), Setting::step);
  const double limit = simulation_of(problem, "rk4", 1.0, {}).stability_limit();
  Check check;
  check.by = "itself at " + in_short(coarser * tolerance) + " m and rk4 at half its stability limit";
  hold_against(dopri5().run(problem, coarser * tolerance, most_seconds), "dopri5", base, check);
  hold_against(rk4.run(problem, std::min(0.5 * limit, 1e-3), most_seconds), "rk4", base, check);
  return check;
}

Check checked(const Problem& problem, const Outcome& base, const Solver* independent, double tolerance,
              double most_seconds)
{
  if (independent != nullptr && cost_of_independence * base.seconds <= most_seconds)
  {
    Check check;
    check.by = independent->name();
    hold_against(independent->run(problem, tolerance, most_seconds), check.by, base, check);
    if (check.failure.empty())
    {
      return check;
    }
  }
  return check_by_itself(problem, base, tolerance, most_seconds);
}

}  // namespace

Reference find_exact_motion(const Problem& problem, const Solver* independent, const MotionSettings& settings)
{
  Reference motion;
  motion.horizon = problem.horizon;
  for (double tolerance = settings.first_tolerance; tolerance >= 0.99 * settings.tightest_tolerance && !motion.accepted;
       tolerance /= coarser)
  {
    const Outcome base = dopri5().run(problem, tolerance, settings.most_seconds);
    if (base.status != Status::ok)
    {
      motion.reason = failure_of("dopri5", base);
      return motion;
    }
    motion.growth = motion.growth > 0.0 ? motion.growth : growth_of(problem, base, tolerance, settings.most_seconds);
    if (motion.growth > settings.most_growth)
    {
      motion.reason = "chaos: a disturbance of 1e-9 m grows " + in_short(motion.growth) + " times";
      return motion;
    }
    const bool is_hopeless = motion.growth * tolerance > hopeless * settings.most_disagreement;
    if (is_hopeless && tolerance > 1.01 * settings.tightest_tolerance)
    {
      continue;
    }
    const Check check = checked(problem, base, independent, tolerance, settings.most_seconds);
    motion.disagreement = check.disagreement;
    motion.accepted = check.failure.empty() && check.disagreement <= settings.most_disagreement;
    motion.samples = motion.accepted ? base.samples : std::vector<ClothState>();
    const std::string differs = "differs by " + in_short(check.disagreement) + " m from " + check.by;
    motion.reason = "dopri5 at " + in_short(tolerance) + " m; " + (check.failure.empty() ? differs : check.failure);
  }
  return motion;
}

Reference find_unchecked_motion(const Problem& problem, const MotionSettings& settings)
{
  Outcome outcome = dopri5().run(problem, settings.first_tolerance, settings.most_seconds);
  Reference motion;
  motion.horizon = problem.horizon;
  motion.accepted = outcome.status == Status::ok;
  motion.reason = motion.accepted ? "unchecked" : failure_of("dopri5", outcome);
  motion.samples = motion.accepted ? std::move(outcome.samples) : std::vector<ClothState>();
  return motion;
}

}  // namespace cloth
