#include "reference.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "errors.h"
#include "own_solver.h"

namespace cloth
{
namespace
{

constexpr double disturbance = 1e-9;  // m

std::string in_short(double number)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", number);
  return text;
}

std::string described(const std::string& solver, const Outcome& outcome, const ReferenceSettings& settings)
{
  return outcome.status == Status::too_slow ?
             solver + " takes longer than " + in_short(settings.most_seconds) + " s for the reference" :
             solver + " ends as " + name_of(outcome.status) + " where it should give the reference";
}

/// At this horizon; the reason of a refusal says nothing of other horizons.
Reference reference_at(const Problem& problem, const Solver& ours, const Solver& other,
                       const ReferenceSettings& settings)
{
  Reference reference;
  reference.horizon = problem.horizon;
  for (double tolerance = settings.first_tolerance; tolerance >= 0.99 * settings.tightest_tolerance; tolerance *= 0.1)
  {
    const Outcome base = ours.run(problem, tolerance, settings.most_seconds);
    if (base.status != Status::ok)
    {
      reference.reason = described(ours.name(), base, settings);
      break;
    }
    if (reference.growth == 0.0)
    {
      const Outcome moved = ours.run(disturbed(problem, disturbance), tolerance, settings.most_seconds);
      for (size_t s = 0; s < std::min(base.samples.size(), moved.samples.size()); ++s)
      {
        const double distance = rms_distance({ moved.samples[s] }, { base.samples[s] });
        reference.growth = std::max(reference.growth, distance / disturbance);
      }
      if (reference.growth * settings.rounding > settings.most_disagreement)
      {
        reference.reason =
            "a disturbance of 1e-9 m grows " + in_short(reference.growth) + " times, and rounding with it";
        break;
      }
    }
    const Outcome check = other.run(problem, tolerance, settings.most_seconds);
    if (check.status != Status::ok)
    {
      reference.reason = described(other.name(), check, settings);
      break;
    }
    reference.disagreement = rms_distance(check.samples, base.samples);
    reference.samples = base.samples;
    reference.accepted = reference.disagreement <= settings.most_disagreement;
    reference.reason = reference.accepted ?
                           "" :
                           ours.name() + " and " + other.name() + " differ by " + in_short(reference.disagreement) +
                               " m at a tolerance of " + in_short(tolerance) + " m; allowed is " +
                               in_short(settings.most_disagreement) + " m, 1 % of the smallest error drawn";
    if (reference.accepted)
    {
      break;
    }
  }
  return reference;
}

}  // namespace

Reference find_reference(const Problem& problem, const Solver* other, const ReferenceSettings& settings)
{
  Reference reference;
  reference.horizon = problem.horizon;
  if (other == nullptr)
  {
    reference.reason = "there is no independent solver to check it with: build with SUNDIALS or Boost";
    return reference;
  }
  const OwnSolver ours(*find_method("dopri5"), Setting::tolerance);
  Problem shortened = problem;
  std::string shortenings;
  for (int halving = 0; halving <= settings.most_halvings; ++halving, shortened.horizon *= 0.5)
  {
    reference = reference_at(shortened, ours, *other, settings);
    if (reference.accepted)
    {
      break;
    }
    shortenings += "over " + in_short(shortened.horizon) + " s " + reference.reason + "; ";
  }
  if (reference.accepted && !shortenings.empty())
  {
    reference.reason = "horizon shortened: " + shortenings.substr(0, shortenings.size() - 2);
  }
  return reference;
}

Reference find_limited_reference(const Problem& problem, const ReferenceSettings& settings)
{
  const OwnSolver ours(*find_method("velocity_verlet"), Setting::step);
  const OwnSolver other(*find_method("rk4"), Setting::step);
  Reference reference;
  reference.horizon = problem.horizon;
  reference.disagreement = std::numeric_limits<double>::infinity();
  double best_step = 0.0;
  std::vector<ClothState> coarser;
  for (const double step : ours.ladder(problem, 2.0))
  {
    const Outcome finer = ours.run(problem, step, settings.most_seconds);
    const Outcome check = other.run(problem, step, settings.most_seconds);
    if (finer.status == Status::too_slow || check.status == Status::too_slow)
    {
      break;
    }
    if (finer.status != Status::ok || check.status != Status::ok)
    {
      continue;
    }
    if (!coarser.empty())
    {
      const double disagreement =
          std::max(rms_distance(coarser, finer.samples), rms_distance(check.samples, finer.samples));
      if (disagreement > 2.0 * reference.disagreement)
      {
        break;
      }
      if (disagreement < reference.disagreement)
      {
        reference.disagreement = disagreement;
        reference.samples = finer.samples;
        best_step = step;
      }
    }
    coarser = finer.samples;
  }
  reference.accepted = reference.disagreement <= settings.most_disagreement;
  if (best_step == 0.0)
  {
    reference.disagreement = 0.0;
    reference.reason = "velocity_verlet and rk4 have no two steps that are stable and quick enough";
  }
  else if (!reference.accepted)
  {
    reference.reason = "velocity_verlet at steps of " + in_short(best_step) +
                       " s, where it comes nearest, differs from itself at twice that or from rk4 by " +
                       in_short(reference.disagreement) + " m; allowed is " + in_short(settings.most_disagreement) +
                       " m";
  }
  return reference;
}

}  // namespace cloth
