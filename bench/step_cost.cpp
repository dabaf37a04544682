// What a spring costs in a step, in seconds: against the size of the sheet, its springs and their damping, the method,
// the vectors' width and the threads, beside loops as one writes them down first (plain_sheet.h).

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "cloth_sim/methods/method.h"
#include "cloth_sim/model/wide_vectors.h"
#include "plain_sheet.h"

namespace cloth
{
namespace
{

/// Far below every stability limit: nothing moves out of the reach of numbers, however long it is measured.
constexpr double time_step = 1e-6;

/// To factorise projective's matrix of a larger sheet takes longer than all else together.
constexpr int largest_factorised = 128;

constexpr const char* default_method = "velocity_verlet";

constexpr SpringProperties off{ 0.0, 0.0 };

/// What is measured; the defaults are those of a scene, but for the wind.
struct Case
{
  std::string name;
  int nodes_a_side;
  SheetProperties sheet{};
  double wind_coupling = 0.0;
  const char* method = default_method;
  VectorWidth width = vector_widths().back();
  int threads = 1;
  Precision precision = Precision::in_double;
  int substeps = 1;  ///< a step; each counts as one
};

/// A sheet that falls from the horizontal, held at two corners; a ripple makes all springs long and short.
ClothState rippled(const ClothModel& model)
{
  ClothState state;
  state.positions = model.rest_positions;
  state.velocities = Vectors::Zero(model.nodes(), 3);
  for (int i = 0; i < model.nodes(); ++i)
  {
    state.positions(i, 1) =
        0.2 * std::sin(9.0 * model.rest_positions(i, 0)) * std::cos(7.0 * model.rest_positions(i, 2));
  }
  return state;
}

void report(benchmark::State& state, std::size_t springs)
{
  state.counters["a_spring"] = benchmark::Counter(
      static_cast<double>(springs), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void step(benchmark::State& state, const Case& measured)
{
  SheetProperties sheet = measured.sheet;
  sheet.rows = sheet.cols = measured.nodes_a_side;
  Dynamics dynamics(make_sheet(sheet), { 0.0, 0.0, -9.81 },
                    { 0.3, measured.wind_coupling, Eigen::Vector3d::Zero(), {} });
  const ClothModel& model = dynamics.model();
  ClothState cloth = rippled(model);
  const std::vector<int> corners{ 0, model.cols - 1 };
  dynamics.pins().hold({ "corners", corners, cloth.positions(corners, Eigen::all), {}, {} });
  dynamics.use_threads(measured.threads);
  MethodSettings settings;
  settings.iterations = measured.substeps;
  settings.precision = measured.precision;
  const double h = measured.substeps * time_step;
  const std::unique_ptr<Method> method = find_method(measured.method)->make(settings);
  use_vector_width(measured.width);
  method->step(dynamics, h, cloth);
  for (auto _ : state)
  {
    method->step(dynamics, h, cloth);
  }
  use_vector_width(vector_widths().back());
  std::size_t springs = 0;
  for (const SpringBatch& batch : model.springs)
  {
    springs += static_cast<std::size_t>(batch.size());
  }
  report(state, springs * static_cast<std::size_t>(measured.substeps));
}

void plain_step(benchmark::State& state, int nodes_a_side)
{
  const SheetProperties defaults;
  const auto springs = [](const SpringProperties& properties) {
    return PlainSheet::Springs{ properties.stiffness, properties.damping };
  };
  PlainSheet sheet(nodes_a_side, defaults.width, defaults.mass, 0.3, springs(defaults.structural),
                   springs(defaults.shear), springs(defaults.flex));
  SheetProperties same = defaults;
  same.rows = same.cols = nodes_a_side;
  const Vectors positions = rippled(make_sheet(same)).positions;
  sheet.positions.assign(positions.data(), positions.data() + positions.size());
  for (auto _ : state)
  {
    sheet.step(time_step);
  }
  report(state, sheet.springs());
}

const char* name_of(VectorWidth width)
{
  switch (width)
  {
    case VectorWidth::four_doubles:
      return "4_doubles";
    case VectorWidth::eight_doubles:
      return "8_doubles";
    case VectorWidth::of_the_build:
      break;
  }
  return "of_the_build";
}

void add(const Case& measured)
{
  const std::string name = measured.name + "/" + std::to_string(measured.nodes_a_side);
  benchmark::RegisterBenchmark(name.c_str(), [measured](benchmark::State& state) {
    step(state, measured);
  })->UseRealTime();
}

void add_width(VectorWidth width, int n)
{
  Case of_width{ std::string("width:") + name_of(width), n };
  of_width.width = width;
  add(of_width);
}

void add_threads(int n)
{
  for (int threads = 2; threads <= usable_threads(); threads *= 2)
  {
    Case shared{ "threads:" + std::to_string(threads), n };
    shared.threads = threads;
    add(shared);
  }
}

void add_all_of_a_size(int n)
{
  benchmark::RegisterBenchmark(("plain/" + std::to_string(n)).c_str(), [n](benchmark::State& state) {
    plain_step(state, n);
  })->UseRealTime();
  for (const VectorWidth width : vector_widths())
  {
    add_width(width, n);
  }
  Case undamped{ "springs:undamped", n };
  undamped.sheet.structural.damping = undamped.sheet.shear.damping = 0.0;
  add(undamped);
  Case no_flex{ "springs:without_flex", n };
  no_flex.sheet.flex = off;
  add(no_flex);
  Case structural{ "springs:structural_alone", n };
  structural.sheet.flex = structural.sheet.shear = off;
  add(structural);
  Case in_wind{ "wind", n };
  in_wind.wind_coupling = 1.0;
  add(in_wind);
  for (const MethodRow& method : methods())
  {
    const bool is_the_default = std::string(method.name) == default_method;
    const bool has_a_large_factor = std::string(method.name) == "projective" && n > largest_factorised;
    if (!is_the_default && !has_a_large_factor)
    {
      Case of_method{ std::string("method:") + method.name, n };
      of_method.method = method.name;
      add(of_method);
    }
  }
  Case mixed{ "precision:mixed", n };
  mixed.method = "xpbd";
  mixed.precision = Precision::mixed;
  mixed.substeps = 32;
  add(mixed);
  add_threads(n);
}

}  // namespace
}  // namespace cloth

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
  {
    return 1;
  }
  for (const int nodes_a_side : { 16, 32, 64, 128, 256, 512 })
  {
    cloth::add_all_of_a_size(nodes_a_side);
  }
  for (const int nodes_a_side : { 40, 48, 56, 96 })  // where a second thread begins to gain
  {
    cloth::add_width(cloth::vector_widths().back(), nodes_a_side);
    cloth::add_threads(nodes_a_side);
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
