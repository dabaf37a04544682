// What the strain limit costs after a step: passes over the springs, and the time of each, against the size of the
// sheet, for both ways to shorten springs; how many passes a substep takes in mixed precision; and how many a stretched
// chain takes from nothing, against its length.

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include <benchmark/benchmark.h>

#include "cloth_sim/forces/springs.h"
#include "cloth_sim/methods/method.h"
#include "level_sheet.h"

namespace cloth
{
namespace
{

constexpr double max_strain = 0.05;
constexpr int most_passes = 100;
constexpr int enough_passes = 100000;
constexpr int measured_steps = 60;
constexpr int steps_before = 60;  // a limit that has just been made knows no tensions

/// 16 steps a frame of 1/60 s for 64 x 64 nodes, more for finer sheets.
double time_step(int nodes_a_side)
{
  return 1.0 / (15.0 * nodes_a_side);
}

StrainLimitProperties limit_by(LimitSolver solver)
{
  return { max_strain, most_passes, solver };
}

/// The sheet of level_sheet.h when it has fallen for 0.3 s and hangs from its two corners.
const ClothState& fallen_state(int nodes_a_side)
{
  static std::map<int, ClothState> states;
  const auto found = states.find(nodes_a_side);
  if (found != states.end())
  {
    return found->second;
  }
  Simulation simulation =
      simulation_of(LevelSheet(nodes_a_side), limit_by(LimitSolver::tensions), "xpbd", time_step(nodes_a_side));
  simulation.advance_to(0.3);
  return states.emplace(nodes_a_side, simulation.state()).first->second;
}

double springs_of(const ClothModel& model)
{
  double springs = 0.0;
  for (const SpringBatch& batch : model.springs)
  {
    springs += batch.kind == SpringKind::flex ? 0.0 : batch.size();
  }
  return springs;
}

/// The same steps in every run: only the limit is timed.
void apply(benchmark::State& benchmark, LimitSolver solver)
{
  const int nodes_a_side = static_cast<int>(benchmark.range(0));
  const double h = time_step(nodes_a_side);
  const LevelSheet sheet(nodes_a_side);
  const Simulation held = simulation_of(sheet, limit_by(solver), "xpbd", h);
  const Dynamics& dynamics = held.dynamics();
  MethodSettings settings;
  settings.iterations = 1;
  const std::unique_ptr<Method> method = find_method("xpbd")->make(settings);
  StrainLimit limit(sheet.model, limit_by(solver));
  ClothState cloth = fallen_state(nodes_a_side);
  const auto step = [&] {
    method->step(dynamics, h, cloth);
    const std::clock_t begin = std::clock();
    const StrainLimit::Report report = limit.apply(sheet.model, dynamics.pins(), h, cloth);
    const double taken = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    method->restart();
    return std::pair(report, taken);
  };
  for (int k = 0; k < steps_before; ++k)
  {
    step();
  }
  double passes = 0.0;
  double reached = 0.0;
  double all = 0.0;  // s of processor time: what else runs makes it no longer
  for (auto _ : benchmark)
  {
    const auto [report, taken] = step();
    benchmark.SetIterationTime(taken);
    all += taken;
    passes += report.sweeps;
    reached += report.reached ? 1.0 : 0.0;
  }
  const auto steps = static_cast<double>(benchmark.iterations());
  benchmark.counters["passes_a_step"] = passes / steps;
  benchmark.counters["reached"] = reached / steps;
  benchmark.counters["a_spring_and_pass"] = all / (passes * springs_of(sheet.model));
}

/// Of xpbd in mixed precision, where the limit is part of the substeps: a second of frames after the sheet has fallen.
void in_mixed_precision(benchmark::State& benchmark)
{
  constexpr double frame = 1.0 / 60.0;
  constexpr int frames_before = 18;
  const int nodes_a_side = static_cast<int>(benchmark.range(0));
  const int substeps = nodes_a_side / 4;
  Simulation simulation = simulation_of(LevelSheet(nodes_a_side), { max_strain, 300, LimitSolver::tensions }, "xpbd",
                                        frame, { 1e-3, substeps, 1.0, Precision::mixed });
  simulation.advance_to(frames_before * frame);
  const std::uint64_t passes_before = simulation.counters().limit_sweeps;
  double worst = 0.0;
  int frames = frames_before;
  for (auto _ : benchmark)
  {
    simulation.advance_to(++frames * frame);
    benchmark.PauseTiming();
    worst = std::max(worst, cloth::max_strain(simulation.model(), simulation.state().positions));
    benchmark.ResumeTiming();
  }
  const auto passes = static_cast<double>(simulation.counters().limit_sweeps - passes_before);
  benchmark.counters["passes_a_substep"] = passes / (substeps * static_cast<double>(benchmark.iterations()));
  benchmark.counters["worst_strain"] = worst;
}

/// A chain that is stretched by a fifth all along, and of which nothing is known.
void from_nothing(benchmark::State& benchmark, LimitSolver solver)
{
  SheetProperties chain;
  chain.rows = static_cast<int>(benchmark.range(0));
  chain.cols = 1;
  const ClothModel model = make_sheet(chain);
  int passes = 0;
  for (auto _ : benchmark)
  {
    StrainLimit limit(model, { max_strain, enough_passes, solver });
    ClothState state{ 1.2 * model.rest_positions, Vectors::Zero(model.nodes(), 3), 0.0 };
    passes = limit.apply(model, Pins(model.nodes()), 1.0, state).sweeps;
  }
  benchmark.counters["passes"] = passes;
}

void by_length(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgName("nodes")->RangeMultiplier(2)->Range(16, 128)->Iterations(1)->Unit(benchmark::kMicrosecond);
}

void by_size(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgName("nodes_a_side")->RangeMultiplier(2)->Range(16, 128);
  benchmark->Iterations(measured_steps)->UseManualTime()->Unit(benchmark::kMicrosecond);
}

BENCHMARK_CAPTURE(apply, tensions, LimitSolver::tensions)->Apply(by_size)->Arg(256);
BENCHMARK_CAPTURE(apply, plain_sweeps, LimitSolver::plain_sweeps)->Apply(by_size);
BENCHMARK(in_mixed_precision)
    ->ArgName("nodes_a_side")
    ->RangeMultiplier(2)
    ->Range(16, 256)
    ->Iterations(measured_steps)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(from_nothing, tensions, LimitSolver::tensions)->Apply(by_length);
BENCHMARK_CAPTURE(from_nothing, plain_sweeps, LimitSolver::plain_sweeps)->Apply(by_length);

}  // namespace
}  // namespace cloth

BENCHMARK_MAIN();
