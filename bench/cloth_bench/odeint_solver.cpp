#include "odeint_solver.h"

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include "first_order_system.h"
#include "interval_clock.h"

namespace cloth
{
namespace
{

namespace odeint = boost::numeric::odeint;

using Unknowns = std::vector<double>;

/// What the first step is tried with, s; the control finds its own from there.
constexpr double first_step = 1e-4;
/// A step that the control wants shorter than this will not end well, s.
constexpr double shortest_step = 1e-12;

template <typename Stepper>
Outcome integrate(const Problem& problem, double tolerance, double most_seconds)
{
  FirstOrderSystem system(problem);
  Unknowns y(static_cast<size_t>(system.size()));
  system.copy_start(y.data());
  const auto slopes = [&system](const Unknowns& at, Unknowns& slope, double time) {
    system.find_slopes(time, at.data(), slope.data());
  };
  auto stepper = odeint::make_controlled(tolerance, tolerance, Stepper());
  Outcome outcome;
  IntervalClock clock(problem, most_seconds);
  double wanted = first_step;
  double time = 0.0;
  const auto advance_to = [&](double end) {
    while (time < end && outcome.status == Status::ok)
    {
      const bool is_last = wanted >= end - time;
      double step = is_last ? end - time : wanted;
      const bool is_taken = stepper.try_step(slopes, y, time, step) == odeint::success;
      wanted = is_last && is_taken ? std::max(wanted, step) : step;
      time = is_last && is_taken ? end : time;
      outcome.status = !(wanted > shortest_step) ? Status::unstable : clock.is_up() ? Status::too_slow : Status::ok;
    }
  };
  for (int s = 0; s < Problem::samples && outcome.status == Status::ok; ++s)
  {
    clock.time([&] { advance_to(problem.time_of(s)); });
    outcome.status =
        outcome.status == Status::ok && system.has_diverged(time, y.data()) ? Status::unstable : outcome.status;
    outcome.samples.push_back(system.state_at(time, y.data()));
  }
  clock.report(outcome);
  outcome.force_evaluations = static_cast<double>(system.evaluations()) / problem.horizon;
  return outcome;
}

}  // namespace

Outcome OdeintSolver::run(const Problem& problem, double value, double most_seconds) const
{
  return formula_ == Formula::dopri5 ?
             integrate<odeint::runge_kutta_dopri5<Unknowns>>(problem, value, most_seconds) :
             integrate<odeint::runge_kutta_fehlberg78<Unknowns>>(problem, value, most_seconds);
}

}  // namespace cloth
