// The measured part of docs/methods.md: what each method of the table costs on a scene, and how exact it is there.
//
//   method_table SCENE.yaml [SECONDS]
//
// Every method takes the step that it chooses by itself. The scene starts unstretched and without the strain limit, so
// that there is one trajectory to be compared with: that of rk4 at a twentieth of its own step. How well that agrees
// with half its step is printed first. Speed is the best of three runs.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "cloth_sim/scene/plan.h"
#include "cloth_sim/scene/scene_reader.h"

namespace
{

using namespace cloth;

struct Run
{
  Vectors positions;
  double time_step = 0.0;
  double seconds = 0.0;
  Simulation::Counters counters;
  bool diverged = false;
};

Run run(SceneParams scene, const std::string& method, double time_step, double duration)
{
  scene.solver.method = method;
  scene.solver.time_step = time_step;
  Simulation simulation = build_simulation(make_plan(scene));
  const auto begin = std::chrono::steady_clock::now();
  simulation.advance_to(duration);
  Run result;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.positions = simulation.state().positions;
  result.counters = simulation.counters();
  result.time_step = duration / static_cast<double>(simulation.counters().steps);
  result.diverged = simulation.divergence().has_value();
  return result;
}

double rms(const Vectors& difference)
{
  return std::sqrt(difference.squaredNorm() / static_cast<double>(difference.rows()));
}

void print_row(const MethodRow& row, const SceneParams& scene, const Vectors& reference, double duration)
{
  Run own = run(scene, row.name, 0.0, duration);
  for (int repeat = 1; repeat < 3; ++repeat)
  {
    own.seconds = std::min(own.seconds, run(scene, row.name, 0.0, duration).seconds);
  }
  if (own.diverged)
  {
    std::printf("| %s | diverged | | | | |\n", row.name);
    return;
  }
  const double error = rms(own.positions - reference);
  const double steps = static_cast<double>(own.counters.steps);
  std::printf("| %s | %.3g ms | %.3g | %.3g | %.1e m | %.3g |\n", row.name, 1e3 * own.time_step,
              static_cast<double>(own.counters.force_evaluations) / steps,
              static_cast<double>(own.counters.linear_solves) / steps, error, duration / own.seconds);
}

int print_table(const std::string& file, double duration)
{
  SceneParams scene = read_scene(load_scene_file(file));
  scene.strain_limit.max_strain = 0.0;
  scene.start.initial_stretch.setOnes();
  const double fine = run(scene, "rk4", 0.0, duration).time_step / 20.0;
  const Vectors reference = run(scene, "rk4", fine, duration).positions;
  std::printf("reference: rk4, agrees with half its step within %.1e m\n\n",
              rms(run(scene, "rk4", 0.5 * fine, duration).positions - reference));
  std::printf("| method | mean step | force evaluations a step | solves a step | RMS error | real-time factor |\n");
  std::printf("|---|---|---|---|---|---|\n");
  for (const MethodRow& row : methods())
  {
    print_row(row, scene, reference, duration);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc < 2 || argc > 3)
  {
    std::fprintf(stderr, "usage: method_table SCENE.yaml [SECONDS]\n");
    return 2;
  }
  try
  {
    return print_table(argv[1], argc > 2 ? std::atof(argv[2]) : 0.5);
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "method_table: %s\n", error.what());
    return 2;
  }
}
