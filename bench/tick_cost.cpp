// What a tick of the node costs besides the simulation's steps, part by part: the messages that are filled, what ROS
// makes of them on the way to other processes, and, once a second, the statistics.

#include <map>
#include <memory>
#include <string>

#include <benchmark/benchmark.h>
#include <ros/serialization.h>

#include "cloth_sim/scene/plan.h"

#include "mesh_marker.h"
#include "messages.h"
#include "pin_markers.h"
#include "spring_marker.h"

namespace cloth
{
namespace
{

/// The sheet of config/hanging_sheet.yaml at another resolution, after a fall of 0.3 s.
struct FallenSheet
{
  explicit FallenSheet(int nodes_a_side) : plan(make_plan(scene_of(nodes_a_side))), simulation(build_simulation(plan))
  {
    simulation.advance_to(0.3);
  }

  static SceneParams scene_of(int nodes_a_side)
  {
    SceneParams scene;
    scene.sheet.rows = nodes_a_side;
    scene.sheet.cols = nodes_a_side;
    scene.start.initial_stretch = { 0.9, 1.0 };
    scene.start.ripple = 0.02;
    scene.plan = "full";  // a tick of a sheet that sleeps is none
    return scene;
  }

  Plan plan;
  Simulation simulation;
};

FallenSheet& the_fallen_sheet(const benchmark::State& state)
{
  static std::map<int, std::unique_ptr<FallenSheet>> sheets;
  const int nodes_a_side = static_cast<int>(state.range(0));
  std::unique_ptr<FallenSheet>& sheet = sheets[nodes_a_side];
  if (!sheet)
  {
    sheet = std::make_unique<FallenSheet>(nodes_a_side);
  }
  return *sheet;
}

MeshMarker mesh_of(const FallenSheet& sheet, bool by_strain)
{
  MeshColouring colouring;
  colouring.by_strain = by_strain;
  return { sheet.simulation.model(), "world", colouring, Eigen::Vector3d::UnitX() };
}

void mesh(benchmark::State& state, bool by_strain)
{
  const FallenSheet& sheet = the_fallen_sheet(state);
  MeshMarker marker = mesh_of(sheet, by_strain);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(marker.update(sheet.simulation.state().positions, ros::Time(1.0)));
  }
}

void springs(benchmark::State& state)
{
  const FallenSheet& sheet = the_fallen_sheet(state);
  SpringMarker marker(sheet.simulation.model(), "world");
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(marker.update(sheet.simulation.state().positions, ros::Time(1.0)));
  }
}

/// Two corners that move from one tick to the next.
void pins(benchmark::State& state)
{
  const FallenSheet& sheet = the_fallen_sheet(state);
  PinMarkers markers(sheet.simulation.model(), "world");
  Vectors positions = sheet.simulation.state().positions;
  for (auto _ : state)
  {
    positions(0, 0) += 1e-6;
    benchmark::DoNotOptimize(markers.update(sheet.simulation.pins().all(), positions, ros::Time(1.0)));
  }
}

void state_message(benchmark::State& state)
{
  const FallenSheet& sheet = the_fallen_sheet(state);
  cloth_sim::ClothState message;
  for (auto _ : state)
  {
    fill_state(sheet.simulation, message);
    benchmark::ClobberMemory();
  }
}

template <typename Message>
void serialise(benchmark::State& state, const Message& message)
{
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(ros::serialization::serializeMessage(message));
  }
  state.counters["bytes"] = ros::serialization::serializationLength(message);
}

void serialise_mesh(benchmark::State& state)
{
  const FallenSheet& sheet = the_fallen_sheet(state);
  serialise(state, *mesh_of(sheet, false).update(sheet.simulation.state().positions, ros::Time(1.0)));
}

void serialise_springs(benchmark::State& state)
{
  const FallenSheet& sheet = the_fallen_sheet(state);
  SpringMarker marker(sheet.simulation.model(), "world");
  serialise(state, *marker.update(sheet.simulation.state().positions, ros::Time(1.0)));
}

void serialise_state(benchmark::State& state)
{
  cloth_sim::ClothState message;
  fill_state(the_fallen_sheet(state).simulation, message);
  serialise(state, message);
}

/// Once a second, text and all. Most of it is the stability limit for the positions as they are.
void statistics(benchmark::State& state)
{
  const FallenSheet& sheet = the_fallen_sheet(state);
  for (auto _ : state)
  {
    const cloth_sim::ClothStats message = stats_message(sheet.simulation, {});
    benchmark::DoNotOptimize(describe(sheet.plan, sheet.simulation, message.stability_limit));
  }
}

void stability_limit(benchmark::State& state)
{
  const FallenSheet& sheet = the_fallen_sheet(state);
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(sheet.simulation.stability_limit());
  }
}

void by_size(benchmark::internal::Benchmark* benchmark)
{
  benchmark->ArgName("nodes_a_side")->Arg(32)->Arg(64)->Arg(128)->Unit(benchmark::kMicrosecond);
}

BENCHMARK_CAPTURE(mesh, fabric, false)->Apply(by_size);
BENCHMARK_CAPTURE(mesh, strain, true)->Apply(by_size);
BENCHMARK(springs)->Apply(by_size);
BENCHMARK(pins)->Apply(by_size);
BENCHMARK(state_message)->Apply(by_size);
BENCHMARK(serialise_mesh)->Apply(by_size);
BENCHMARK(serialise_springs)->Apply(by_size);
BENCHMARK(serialise_state)->Apply(by_size);
BENCHMARK(statistics)->Apply(by_size);
BENCHMARK(stability_limit)->Apply(by_size);

}  // namespace
}  // namespace cloth

BENCHMARK_MAIN();
