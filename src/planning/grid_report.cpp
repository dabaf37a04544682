#include "grid_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "cloth_sim/scene/yaml_text.h"
#include "cloth_sim/simulation/statics.h"

#include "model_parts.h"
#include "pilot.h"
#include "step_search.h"

namespace cloth
{
namespace
{

/// The fewest cells a side that make a cloth.
constexpr int fewest_cells = 4;
constexpr double rest_tolerance = 1e-6;
constexpr double most_evaluations = 1e6;

struct Difference
{
  double of_motion;
  double of_rest;  ///< not a number: one of the two does not come to rest
};

Vectors at_nodes_of(const StartedScene& coarse, const StartedScene& fine, const Vectors& positions)
{
  const SheetProperties& from = fine.params.sheet;
  const SheetProperties& to = coarse.params.sheet;
  return interpolated(positions, from.rows, from.cols, to.rows, to.cols);
}

/// On the grid of `coarse`, of which that of `scene` has all nodes.
Motion motion_at(const StartedScene& coarse, const StartedScene& scene, const Stepping& stepping)
{
  Motion motion = motion_of(scene, stepping, most_evaluations);
  for (Vectors& positions : motion.positions)
  {
    positions = at_nodes_of(coarse, scene, positions);
  }
  return motion;
}

/// No rows: there is no rest.
Vectors rest_at(const StartedScene& coarse, const StartedScene& scene, const Stepping& stepping)
{
  const Simulation simulation = simulation_of(scene, stepping);
  if (simulation.model().springs.empty())
  {
    return Vectors(0, 3);
  }
  Vectors positions = simulation.state().positions;
  const StaticsReport report = settle(simulation.model(), simulation.pins(), scene.params.gravity,
                                      scene.params.strain_limit.max_strain, rest_tolerance, positions);
  return report.converged ? at_nodes_of(coarse, scene, positions) : Vectors(0, 3);
}

Difference difference_from_twice_as_fine(const StartedScene& coarse, const Stepping& stepping)
{
  const StartedScene fine = finer(coarse, 2);
  const Vectors rest = rest_at(coarse, coarse, stepping);
  const Vectors fine_rest = rest_at(coarse, fine, stepping);
  const bool both_rest = rest.rows() > 0 && fine_rest.rows() > 0;
  return { distance(motion_at(coarse, coarse, stepping), motion_at(coarse, fine, stepping)),
           both_rest ? std::sqrt((rest - fine_rest).squaredNorm() / static_cast<double>(rest.rows())) :
                       std::numeric_limits<double>::quiet_NaN() };
}

std::string in_words(const Difference& difference)
{
  return in_two_digits(difference.of_motion) + " m in motion and " +
         (std::isnan(difference.of_rest) ? "no rest to compare" : in_two_digits(difference.of_rest) + " m at rest");
}

}  // namespace

std::string grid_report(const StartedScene& scene, const Choice& choice, StepCosts& costs)
{
  StartedScene reduced = scene;
  reduced.params = without(reduced.params, choice.left_out);
  const SheetProperties& given = scene.params.sheet;
  const double tolerance = scene.params.solver.tolerance;
  const Stepping stepping{ "velocity_verlet" };
  int coarsest_factor = 2;
  while (std::min(given.rows, given.cols) - 1 >= 2 * coarsest_factor * fewest_cells)
  {
    coarsest_factor *= 2;
  }
  std::string nearest = "none with fewer cells was compared";
  for (int factor = coarsest_factor; factor >= 2; factor /= 2)
  {
    const StartedScene coarse = coarser(reduced, factor, 2);
    const SheetProperties& sheet = coarse.params.sheet;
    const std::string name = std::to_string(sheet.rows) + " x " + std::to_string(sheet.cols) + " nodes";
    const Difference difference = difference_from_twice_as_fine(coarse, stepping);
    const bool rests_alike = std::isnan(difference.of_rest) || difference.of_rest < tolerance;
    if (difference.of_motion < tolerance && rests_alike)
    {
      const Simulation simulation = simulation_of(coarse, stepping);
      const double cost = costs.of_a_step(coarse, stepping) / simulation.time_step();
      return name + " would do: twice as fine they differ by " + in_words(difference) + ", and take " +
             in_two_digits(cost) + " s of work a second instead of " + in_two_digits(choice.cost) + " s";
    }
    nearest = name + " differ from twice as fine by " + in_words(difference);
  }
  return "as the scene says; no coarser grid is as good as the tolerance of " + format_number(tolerance) +
         " m: " + nearest;
}

}  // namespace cloth
