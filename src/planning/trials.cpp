#include "trials.h"

#include <algorithm>
#include <cmath>

#include "cloth_sim/scene/scene_reader.h"
#include "cloth_sim/scene/yaml_text.h"

#include "model_parts.h"

namespace cloth
{
namespace
{

constexpr int fewest_nodes = 8;
constexpr int most_factor = 16;
/// What all trials may take, s of work, about; and how many there are, in runs of the scout at its longest step.
constexpr double most_seconds = 3.0;
constexpr double expected_trials = 12.0;

/// How many samples on are enough to compare the errors of a sheet, which has more modes to be wrong about, with those
/// of the coarser one of a trial; by how much they may differ, and what is taken where to find out takes too long.
constexpr int early_samples = 2;
constexpr double most_allowance = 30.0;
constexpr double untried_allowance = 3.0;

double scout_step(const StartedScene& scene)
{
  return simulation_of(scene, { scout }).time_step();
}

double nodes_of(const StartedScene& scene)
{
  return static_cast<double>(scene.start.state.positions.rows());
}

int coarsening_of(const StartedScene& scene, double seconds_a_run)
{
  int factor = 2;
  for (double seconds = expected_trials * seconds_a_run / 8.0; seconds > most_seconds && factor < most_factor;
       seconds /= 8.0)
  {
    factor *= 2;
  }
  return std::min(scene.params.sheet.rows, scene.params.sheet.cols) <= fewest_nodes ? 1 : factor;
}

/// The sheet itself where pins that are apart would come to hold the same node.
StartedScene pilot_of(const StartedScene& scene, int factor)
{
  StartedScene pilot = coarser(scene, factor, fewest_nodes);
  try
  {
    simulation_of(pilot, { scout });
  }
  catch (const SceneError&)
  {
    return scene;
  }
  return pilot;
}

}  // namespace

const char* const scout = "velocity_verlet";

Trials::Trials(const StartedScene& scene, StepCosts& costs)
  : scene_(scene)
  , costs_(costs)
  , longest_step_(scout_step(scene))
  , most_work_(Motion::horizon / longest_step_ * nodes_of(scene))
{
  const double seconds_a_run = Motion::horizon / longest_step_ * costs.of_a_step(scene, { scout });
  pilot_ = pilot_of(scene, coarsening_of(scene, seconds_a_run));
  longest_step_ = scout_step(pilot_);
}

bool Trials::is_coarser() const
{
  return nodes_of(pilot_) < nodes_of(scene_);
}

double Trials::coarseness() const
{
  const SheetProperties& fine = scene_.params.sheet;
  const SheetProperties& coarse = pilot_.params.sheet;
  const auto ratio = [](int cells, int coarse_cells) {
    return coarse_cells > 0 ? static_cast<double>(cells) / coarse_cells : 1.0;
  };
  return std::max(ratio(fine.rows - 1, coarse.rows - 1), ratio(fine.cols - 1, coarse.cols - 1));
}

double Trials::grid_allowance()
{
  if (!is_coarser())
  {
    return 1.0;
  }
  const double step = scout_step(scene_);
  const double seconds_a_run = Motion::horizon / step * costs_.of_a_step(scene_, { scout });
  if (3.0 * seconds_a_run * early_samples / Motion::samples > most_seconds)
  {
    return untried_allowance;
  }
  const auto error_on = [&](const StartedScene& scene) {
    return distance(run(scene, { scout, step }, early_samples), run(scene, { scout, 0.5 * step }, early_samples),
                    early_samples);
  };
  const double ratio = error_on(scene_) / error_on(pilot_);
  return std::isfinite(ratio) ? std::clamp(ratio, 1.0, most_allowance) : most_allowance;
}

double Trials::change_without(const std::vector<std::string>& parts)
{
  StartedScene lesser = pilot_;
  lesser.params = without(lesser.params, parts);
  const Stepping stepping{ scout, longest_step_ };
  return distance(motion(stepping), run(lesser, stepping));
}

void Trials::leave_out(const std::vector<std::string>& parts)
{
  scene_.params = without(scene_.params, parts);
  pilot_.params = without(pilot_.params, parts);
  motions_.clear();
  longest_step_ = scout_step(pilot_);
}

const Motion& Trials::motion(const Stepping& stepping)
{
  const std::string key = stepping.method + " " + format_number(stepping.time_step) + " " +
                          format_number(stepping.tolerance) + " " + std::to_string(stepping.iterations);
  const auto known = motions_.find(key);
  return known != motions_.end() ? known->second : motions_.emplace(key, run(pilot_, stepping)).first->second;
}

Motion Trials::run(const StartedScene& scene, const Stepping& stepping, int samples)
{
  constexpr double margin = 50.0;
  const auto most_steps = static_cast<std::uint64_t>(margin * Motion::horizon / longest_step_);
  Motion motion = motion_of(scene, stepping, most_steps, samples);
  const Simulation::Counters& counters = motion.counters;
  work_ += static_cast<double>(counters.force_evaluations + counters.linear_iterations + counters.limit_sweeps) *
           nodes_of(scene);
  return motion;
}

}  // namespace cloth
