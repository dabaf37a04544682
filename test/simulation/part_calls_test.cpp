#include "cloth_sim/model/part_calls.h"

#include <functional>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "support.h"

namespace cloth
{
namespace
{

/// A way to leave something out, and all parts that are gone with it.
struct LeftOut
{
  std::string name;
  std::function<void(SceneParams&)> leave_out;
  std::set<Part> parts;
};

const std::vector<LeftOut>& all_ways()
{
  static const std::vector<LeftOut> ways{
    { "structural springs",
      [](SceneParams& scene) { scene.sheet.structural.stiffness = 0.0; },
      { Part::structural_springs } },
    { "shear springs", [](SceneParams& scene) { scene.sheet.shear.stiffness = 0.0; }, { Part::shear_springs } },
    { "flex springs", [](SceneParams& scene) { scene.sheet.flex.stiffness = 0.0; }, { Part::flex_springs } },
    { "internal damping",
      [](SceneParams& scene) {
        scene.sheet.structural.damping = scene.sheet.shear.damping = scene.sheet.flex.damping = 0.0;
      },
      { Part::internal_damping } },
    { "gravity", [](SceneParams& scene) { scene.gravity.setZero(); }, { Part::gravity } },
    { "viscous damping", [](SceneParams& scene) { scene.air.viscous_damping = 0.0; }, { Part::viscous_damping } },
    { "wind", [](SceneParams& scene) { scene.air.wind_coupling = 0.0; }, { Part::wind, Part::normals } },
    { "strain limit",
      [](SceneParams& scene) { scene.strain_limit.max_strain = 0.0; },
      { Part::strain_limit, Part::strain_watch } },
    { "moving pins", [](SceneParams& scene) { scene.pins[1].motion = {}; }, { Part::pin_motions } },
    { "pins", [](SceneParams& scene) { scene.pins.clear(); }, { Part::pins, Part::pin_motions } },
  };
  return ways;
}

SceneParams scene_of_everything(const char* method)
{
  SceneParams scene = shipped_scene("hanging_sheet");
  scene.sheet.rows = scene.sheet.cols = 6;
  scene.sheet.structural.damping = scene.sheet.shear.damping = scene.sheet.flex.damping = 0.01;
  scene.start.initial_stretch = { 1.05, 1.05 };
  scene.strain_limit.max_strain = 0.02;
  scene.air.wind = { 1.0, 3.0, 0.0 };
  scene.pins[1].motion = { { 0.0, 0.1, 0.05 }, 1.0, 0.0 };
  scene.solver.method = method;
  scene.solver.time_step = 5e-4;
  return scene;
}

PartCalls calls_of(const SceneParams& scene)
{
  Simulation simulation = build_simulation(make_plan(scene));
  EXPECT_TRUE(simulation.advance_to(0.01)) << simulation.divergence_report();
  return simulation.counters().calls;
}

void expect_calls_of_what_is_not_left_out(const SceneParams& everything)
{
  const PartCalls all = calls_of(everything);
  for (const LeftOut& way : all_ways())
  {
    SceneParams scene = everything;
    way.leave_out(scene);
    const PartCalls calls = calls_of(scene);
    for (std::size_t i = 0; i < number_of_parts; ++i)
    {
      const Part part = static_cast<Part>(i);
      EXPECT_GT(all[part], 0u) << name_of(part);
      if (way.parts.count(part) > 0)
      {
        EXPECT_EQ(calls[part], 0u) << name_of(part) << " without " << way.name;
      }
      else if (part != Part::strain_limit)  // which may have nothing to do then
      {
        EXPECT_GT(calls[part], 0u) << name_of(part) << " without " << way.name;
      }
    }
  }
}

class PartCallsOfEveryMethod : public testing::TestWithParam<MethodRow>
{
};

TEST_P(PartCallsOfEveryMethod, AreNoneOfWhatIsLeftOutAndSomeOfAllElse)
{
  expect_calls_of_what_is_not_left_out(scene_of_everything(GetParam().name));
}

INSTANTIATE_TEST_SUITE_P(Methods, PartCallsOfEveryMethod, testing::ValuesIn(methods()), name_of_method);

TEST(PartCalls, OfMixedPrecisionAreNoneOfWhatIsLeftOutAndSomeOfAllElse)
{
  SceneParams everything = scene_of_everything("xpbd");
  everything.solver.precision = Precision::mixed;
  everything.solver.time_step = 0.01;
  expect_calls_of_what_is_not_left_out(everything);
}

TEST(PartCalls, AreOnePerBatchAndEvaluation)
{
  SimulationSetup setup = springs_alone(small_sheet(), "symplectic_euler", 1e-3);
  Simulation simulation(setup);
  ASSERT_TRUE(simulation.advance_to(7e-3));
  const PartCalls& calls = simulation.counters().calls;
  EXPECT_EQ(simulation.counters().force_evaluations, 7u);
  EXPECT_EQ(calls[Part::structural_springs], 14u);
  EXPECT_EQ(calls[Part::shear_springs], 14u);
  EXPECT_EQ(calls[Part::flex_springs], 14u);
  EXPECT_EQ(calls[Part::internal_damping], 42u);
  EXPECT_EQ(calls[Part::gravity], 0u);
}

TEST(PartCalls, AreTheSameForAnyNumberOfThreads)
{
  for (const char* const method : { "velocity_verlet", "rk4", "symplectic_euler" })
  {
    const auto calls_with = [method](int threads) {
      SceneParams scene = shipped_scene("hanging_sheet");
      scene.sheet.rows = 100;
      scene.sheet.cols = 64;
      scene.air.wind = { 1.0, 3.0, 0.0 };
      scene.solver.method = method;
      scene.solver.threads = threads;
      Simulation simulation = build_simulation(make_plan(scene));
      EXPECT_EQ(simulation.dynamics().threads(), threads);
      simulation.advance_to(0.005);
      return simulation.counters().calls.counts;
    };
    const auto of_one = calls_with(1);
    EXPECT_EQ(calls_with(2), of_one) << method;
    EXPECT_EQ(calls_with(3), of_one) << method;
  }
}

TEST(PartCalls, AreKeptApartBetweenSimulationsOfOneThread)
{
  Simulation one(springs_alone(small_sheet(), "symplectic_euler", 1e-3));
  Simulation other(springs_alone(small_sheet(), "symplectic_euler", 1e-3));
  for (int k = 1; k <= 4; ++k)
  {
    one.advance_to(1e-3 * k);
    other.advance_to(2e-3 * k);
  }
  EXPECT_EQ(2 * one.counters().calls[Part::shear_springs], other.counters().calls[Part::shear_springs]);
}

}  // namespace
}  // namespace cloth
