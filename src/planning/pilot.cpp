#include "pilot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cloth_sim/forces/springs.h"
#include "cloth_sim/scene/plan.h"

namespace cloth
{
namespace
{

/// Of conjugate gradients, on small sheets.
constexpr double evaluations_of_an_iteration = 5.0;

int common_samples(const Motion& one, const Motion& other)
{
  return static_cast<int>(std::min(one.positions.size(), other.positions.size()));
}

/// Of the distances at each sample, m2.
double sum_of_squares(const Motion& one, const Motion& other, int samples)
{
  double sum = 0.0;
  for (int s = 0; s < samples; ++s)
  {
    sum += (one.positions[s] - other.positions[s]).squaredNorm() / static_cast<double>(one.positions[s].rows());
  }
  return sum;
}

}  // namespace

Simulation simulation_of(const StartedScene& scene, const Stepping& stepping)
{
  SceneParams params = scene.params;
  params.solver.method = stepping.method;
  params.solver.time_step = stepping.time_step;
  params.solver.tolerance = stepping.tolerance;
  params.solver.iterations = stepping.iterations;
  Plan plan = make_plan(params, scene.start);
  plan.keeps_within_limit = true;
  return build_simulation(plan);
}

double evaluations_in(const Simulation::Counters& counters)
{
  return static_cast<double>(counters.force_evaluations + counters.limit_sweeps) +
         evaluations_of_an_iteration * static_cast<double>(counters.linear_iterations);
}

Motion motion_of(const StartedScene& scene, const Stepping& stepping, double most_evaluations, int samples,
                 const std::function<bool(const Motion&)>& is_enough)
{
  Simulation simulation = simulation_of(scene, stepping);
  const double begin = simulation.state().time;
  const auto takes_too_long = [&] { return evaluations_in(simulation.counters()) > most_evaluations; };
  Motion motion;
  for (int s = 1; s <= samples && !takes_too_long(); ++s)
  {
    const double time = begin + Motion::horizon * s / Motion::samples;
    if (!simulation.advance_to(time, takes_too_long) || simulation.state().time < time)
    {
      break;
    }
    motion.positions.push_back(simulation.state().positions);
    if (const double held = simulation.strain_limit().held_strain(); held > 0.0)
    {
      motion.excess = std::max(motion.excess, max_strain(simulation.model(), motion.positions.back()) / held - 1.0);
    }
    if (is_enough && is_enough(motion))
    {
      break;
    }
  }
  motion.counters = simulation.counters();
  return motion;
}

double distance(const Motion& one, const Motion& other, int samples)
{
  return common_samples(one, other) < samples ? std::numeric_limits<double>::infinity() :
                                                std::sqrt(sum_of_squares(one, other, samples) / samples);
}

double least_distance(const Motion& one, const Motion& other)
{
  return std::sqrt(sum_of_squares(one, other, common_samples(one, other)) / Motion::samples);
}

}  // namespace cloth
