#include "own_solver.h"

#include <algorithm>
#include <cmath>

#include "cloth_sim/methods/spectrum.h"
#include "interval_clock.h"

namespace cloth
{
namespace
{

/// The longest step that is tried where stability asks for none, s.
constexpr double longest_step = 1.0 / 30.0;
constexpr double step_of_iterations = 1.0 / 240.0;
/// Where more than this part of its steps left its equations unsolved, a run has not converged.
constexpr double unconverged_part = 0.01;

/// An explicit method's ladder begins above the limit of velocity_verlet, at least: its own may be 0, or bound modes
/// that the scene does not have.
double first_step(const Problem& problem, const MethodRow& row)
{
  const Simulation simulation = simulation_of(problem, row.name, 1.0, {});
  const Spectrum spectrum = spectrum_of(simulation.dynamics(), simulation.state().positions);
  const double own = network_stability_limit(row, spectrum);
  const double limit = std::max(own, network_stability_limit(*find_method("velocity_verlet"), spectrum));
  return std::isinf(own) ? longest_step : std::min(longest_step, 2.0 * limit);
}

std::vector<double> steps_from(double first, const Problem& problem, double ratio)
{
  const double interval = problem.sample_interval();
  double steps = std::exp2(std::max(0.0, std::ceil(std::log2(interval / first))));
  std::vector<double> ladder;
  for (; interval / steps > 2.0 * Simulation::shortest_step; steps *= ratio)
  {
    ladder.push_back(interval / steps);
  }
  return ladder;
}

}  // namespace

Outcome outcome_of(Simulation& simulation, const Problem& problem, double most_seconds)
{
  Outcome outcome;
  IntervalClock clock(problem, most_seconds);
  for (int s = 0; s < Problem::samples && outcome.status == Status::ok; ++s)
  {
    const double end = problem.time_of(s);
    clock.time([&] { simulation.advance_to(end, [&] { return clock.is_up(); }); });
    outcome.samples.push_back(simulation.state());
    outcome.status = simulation.divergence()                   ? Status::unstable :
                     simulation.state().time < end             ? Status::too_slow :
                     s + 1 < Problem::samples && clock.is_up() ? Status::too_slow :
                                                                 Status::ok;
  }
  clock.report(outcome);
  const Simulation::Counters& counters = simulation.counters();
  outcome.force_evaluations = static_cast<double>(counters.force_evaluations) / problem.horizon;
  outcome.linear_solves = static_cast<double>(counters.linear_solves) / problem.horizon;
  const bool is_unsolved =
      static_cast<double>(counters.unconverged_steps) > unconverged_part * static_cast<double>(counters.steps);
  outcome.status = outcome.status == Status::ok && is_unsolved ? Status::not_converged : outcome.status;
  return outcome;
}

std::vector<double> tolerances()
{
  std::vector<double> ladder;
  for (int digits = 1; digits <= 12; ++digits)
  {
    ladder.push_back(1.0 / std::pow(10.0, digits));
  }
  return ladder;
}

std::vector<double> OwnSolver::ladder(const Problem& problem, double ratio) const
{
  switch (setting_)
  {
    case Setting::tolerance:
      return tolerances();
    case Setting::iterations:
      return { 1, 2, 5, 10, 20, 50, 100, 200, 500 };
    default:
      return steps_from(first_step(problem, row_), problem, ratio);
  }
}

Outcome OwnSolver::run(const Problem& problem, double value, double most_seconds) const
{
  MethodSettings settings;
  settings.tolerance = setting_ == Setting::tolerance ? value : settings.tolerance;
  settings.iterations = setting_ == Setting::iterations  ? static_cast<int>(value) :
                        std::string(row_.name) == "xpbd" ? 1 :
                                                           problem.plan.scene.solver.iterations;
  const double time_step = setting_ == Setting::step       ? value :
                           setting_ == Setting::iterations ? step_of_iterations :
                                                             0.0;
  Simulation simulation = simulation_of(problem, row_.name, time_step, settings);
  return outcome_of(simulation, problem, most_seconds);
}

Solvers own_solvers()
{
  Solvers solvers;
  for (const MethodRow& row : methods())
  {
    solvers.push_back(std::make_unique<OwnSolver>(row, row.is_adaptive ? Setting::tolerance : Setting::step));
  }
  solvers.push_back(std::make_unique<OwnSolver>(*find_method("projective"), Setting::iterations));
  return solvers;
}

}  // namespace cloth
