// When a cloth goes to sleep, and what wakes it.

#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "cloth_sim/simulation/simulation.h"
#include "cloth_sim/simulation/statics.h"
#include "support.h"

namespace cloth
{
namespace
{

constexpr double tick = 1.0 / 30.0;
constexpr double distance = 2.5e-4;  // a quarter of the default tolerance

double farthest(const Vectors& one, const Vectors& other)
{
  return std::sqrt((one - other).rowwise().squaredNorm().maxCoeff());
}

/// It hangs by two corners and comes to rest in some 10 s.
SceneParams hanging_sheet()
{
  SceneParams scene = shipped_scene("hanging_sheet");
  scene.sheet.rows = scene.sheet.cols = 8;
  return scene;
}

SceneParams stiff_sheet_without_limit()
{
  SceneParams scene = hanging_sheet();
  scene.strain_limit.max_strain = 0.0;
  scene.sheet.structural.stiffness = scene.sheet.shear.stiffness = 1e3;
  return scene;
}

/// As if trials had chosen this method.
Plan plan_of(const SceneParams& scene)
{
  Choice choice;
  choice.method = "velocity_verlet";
  return make_plan(scene, choice);
}

Simulation simulation_of(const SceneParams& scene)
{
  return build_simulation(plan_of(scene));
}

Simulation without_sleep(SceneParams scene)
{
  scene.plan = "full";
  return simulation_of(scene);
}

/// Goes on by ticks.
void run(Simulation& simulation, double duration)
{
  const double begin = simulation.state().time;
  for (int k = 1; k * tick < duration + 0.5 * tick; ++k)
  {
    ASSERT_TRUE(simulation.advance_to(begin + k * tick)) << simulation.divergence_report();
  }
}

void run_until_asleep(Simulation& simulation, double longest)
{
  const double begin = simulation.state().time;
  while (!simulation.asleep_since() && simulation.state().time < begin + longest)
  {
    run(simulation, tick);
  }
}

Simulation asleep(const SceneParams& scene)
{
  Simulation simulation = simulation_of(scene);
  run_until_asleep(simulation, 120.0);
  EXPECT_TRUE(simulation.asleep_since());
  return simulation;
}

TEST(Sleep, DoesNotDriftByABitAndTakesNoSteps)
{
  Simulation simulation = asleep(hanging_sheet());
  const Vectors shape = simulation.state().positions;
  const std::uint64_t steps = simulation.counters().steps;
  const double begin = simulation.state().time;
  run(simulation, 100.0);
  EXPECT_EQ(simulation.state().positions, shape);
  EXPECT_TRUE(simulation.state().velocities.isZero(0.0));
  EXPECT_EQ(simulation.counters().steps, steps);
  EXPECT_NEAR(simulation.state().time, begin + 100.0, 1e-9);
}

TEST(Sleep, HasTheShapeThatGoingOnWouldGive)
{
  for (const SceneParams& scene : { hanging_sheet(), stiff_sheet_without_limit() })
  {
    const Simulation simulation = asleep(scene);
    Simulation other = without_sleep(scene);
    run(other, *simulation.asleep_since() + 60.0);
    EXPECT_FALSE(other.asleep_since());
    EXPECT_LT(farthest(simulation.state().positions, other.state().positions), distance);
    EXPECT_GT(simulation.asleep_since(), 2.0);
  }
}

TEST(Sleep, NeverTakesASwingAtItsTurningPoint)
{
  for (int seed = 0; seed < 4; ++seed)
  {
    for (const double viscous_damping : { 0.0, 0.005, 0.1 })
    {
      SceneParams scene = stiff_sheet_without_limit();
      scene.air.viscous_damping = viscous_damping;
      scene.air.wind_coupling = 0.0;
      scene.pins = { { "edge", "top", {}, {} } };
      Noise noise;
      for (int drawn = 0; drawn < seed; ++drawn)
      {
        noise.vector();
      }
      scene.start.velocity = 0.02 * noise.vector();
      Simulation simulation = simulation_of(scene);
      Simulation other = without_sleep(scene);
      run_until_asleep(simulation, 30.0);
      run(other, simulation.state().time);
      if (viscous_damping < 0.1)
      {
        EXPECT_FALSE(simulation.asleep_since()) << seed << ", " << viscous_damping;
      }
      const Vectors shape = simulation.state().positions;
      for (int k = 0; k < 60 && simulation.asleep_since(); ++k)
      {
        run(other, 0.1);
        EXPECT_LT(farthest(shape, other.state().positions), distance) << seed << ", " << viscous_damping;
      }
    }
  }
}

TEST(Sleep, WaitsForTheEndOfASwingInTheHoldOfTheStrainLimit)
{
  SceneParams scene = hanging_sheet();
  scene.air.viscous_damping = 0.1;
  scene.air.wind_coupling = 0.0;
  Simulation simulation = simulation_of(scene);
  Simulation other = without_sleep(scene);
  run_until_asleep(simulation, 45.0);
  EXPECT_GT(simulation.counters().limit_sweeps, 0u);
  run(other, simulation.state().time);
  const Vectors shape = simulation.state().positions;
  for (int k = 0; k < 40 && simulation.asleep_since(); ++k)
  {
    run(other, 0.1);
    EXPECT_LT(farthest(shape, other.state().positions), distance);
  }
}

/// Steps that changed their length, and tensions that were not passed over often enough, shook it for ever.
TEST(Sleep, ComesToASheetThatHangsInItsStrainLimit)
{
  SceneParams scene = shipped_scene("hanging_sheet");
  scene.strain_limit.max_strain = 0.05;
  Simulation simulation = simulation_of(scene);
  run_until_asleep(simulation, 30.0);
  EXPECT_TRUE(simulation.asleep_since());
  EXPECT_GT(max_strain(simulation.model(), simulation.state().positions), 0.99 * scene.strain_limit.max_strain);
}

TEST(Sleep, DoesNotTakeWhatCreepsForRest)
{
  for (const double max_strain : { 0.0, 0.1 })
  {
    SceneParams scene = hanging_sheet();
    scene.strain_limit.max_strain = max_strain;
    scene.air.viscous_damping = 5e5;
    scene.start.initial_stretch.setOnes();
    Simulation simulation = simulation_of(scene);
    run(simulation, 5.0);
    const Vectors before = simulation.state().positions;
    run(simulation, 1.0);
    EXPECT_LT(farthest(before, simulation.state().positions), distance) << "it is slow";
    Vectors rest = before;
    ASSERT_TRUE(settle(simulation.model(), simulation.pins(), scene.gravity, max_strain, 1e-8, rest).converged);
    EXPECT_GT(farthest(before, rest), 100.0 * distance) << "and far from rest";
    run(simulation, 60.0);
    EXPECT_FALSE(simulation.asleep_since());
  }
}

TEST(Sleep, ComesAtOnceToASettledStart)
{
  SceneParams scene = hanging_sheet();
  scene.start.shape = "settled";
  Simulation simulation = simulation_of(scene);
  const Vectors start = simulation.state().positions;
  ASSERT_TRUE(simulation.advance_to(10.0));
  EXPECT_EQ(simulation.asleep_since(), 0.0);
  EXPECT_EQ(simulation.counters().steps, 0u);
  EXPECT_EQ(simulation.state().positions, start);
  EXPECT_EQ(simulation.state().time, 10.0);
  scene.start.velocity = { 0.0, 0.1, 0.0 };
  Simulation pushed = simulation_of(scene);
  run(pushed, tick);
  EXPECT_FALSE(pushed.asleep_since());
}

TEST(Sleep, DoesNotComeWhereSomethingDrivesTheSheet)
{
  const std::vector<std::pair<std::string, std::function<void(SceneParams&)>>> drives{
    { "gusts", [](SceneParams& scene) { scene.air.gusts.strength = 1e-9; } },
    { "wind",
      [](SceneParams& scene) {
        scene.air.wind = { 0.0, 1e-9, 0.0 };
      } },
    { "pins",
      [](SceneParams& scene) {
        scene.pins[0].motion = { { 0.0, 0.0, 1e-9 }, 0.01, 0.0 };
      } },
  };
  for (const auto& [name, drive] : drives)
  {
    SceneParams scene = hanging_sheet();
    scene.start.shape = "settled";
    drive(scene);
    Simulation simulation = simulation_of(scene);
    run_until_asleep(simulation, 30.0);
    EXPECT_FALSE(simulation.asleep_since()) << name;
  }
}

TEST(Sleep, TakesASheetThatNothingHoldsOnlyWhereItDoesNotMoveByABit)
{
  SceneParams scene = hanging_sheet();
  scene.pins.clear();
  scene.gravity.setZero();
  scene.sheet.structural.stiffness = scene.sheet.shear.stiffness = scene.sheet.flex.stiffness = 0.0;
  Simulation still = simulation_of(scene);
  run_until_asleep(still, 3.0);
  EXPECT_TRUE(still.asleep_since());
  scene.start.velocity = { 0.0, 0.0, 1e-6 };
  Simulation drifting = simulation_of(scene);
  run_until_asleep(drifting, 3.0);
  EXPECT_FALSE(drifting.asleep_since());
  scene.start.velocity.setZero();
  scene.gravity = { 0.0, 0.0, -1e-9 };
  Simulation falling = simulation_of(scene);
  run_until_asleep(falling, 3.0);
  EXPECT_FALSE(falling.asleep_since());
}

TEST(Sleep, IsForAPlanThatMayLeaveOutAndChoose)
{
  SceneParams scene = hanging_sheet();
  scene.start.shape = "settled";
  scene.plan = "full";
  SceneParams chosen = hanging_sheet();
  chosen.start.shape = "settled";
  chosen.solver.method = "velocity_verlet";
  for (const SceneParams& other : { scene, chosen })
  {
    Simulation simulation = simulation_of(other);
    run(simulation, tick);
    EXPECT_FALSE(simulation.asleep_since());
    EXPECT_GT(simulation.counters().steps, 0u);
  }
}

struct Change
{
  std::string name;
  std::function<void(Simulation&)> make;
};

const std::vector<Change>& waking_changes()
{
  static const std::vector<Change> changes{
    { "wind",
      [](Simulation& simulation) {
        simulation.set_wind({ 0.0, 1.0, 0.0 });
      } },
    { "hold", [](Simulation& simulation) { simulation.hold("hand", { 60 }); } },
    { "release", [](Simulation& simulation) { simulation.release("left"); } },
    { "release all", [](Simulation& simulation) { simulation.release_all(); } },
    { "carry",
      [](Simulation& simulation) {
        const Eigen::Vector3d middle = simulation.pins().find("left")->middle(simulation.state().time);
        simulation.carry("left", middle + Eigen::Vector3d(0.0, 0.01, 0.0), 0.1);
      } },
    { "turn",
      [](Simulation& simulation) {
        const Eigen::Isometry3d turn(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()));
        simulation.carry("left", turn, Eigen::Vector3d::Zero(), simulation.state().time + 0.1);
      } },
    { "reactions", [](Simulation& simulation) { simulation.measure_reactions(true); } },
  };
  return changes;
}

TEST(Sleep, EndsWithTheFirstStepAfterAChangeAndLeavesNoTrace)
{
  const SceneParams scene = stiff_sheet_without_limit();
  for (const Change& change : waking_changes())
  {
    Simulation simulation = asleep(scene);
    run(simulation, 1.0);
    SceneParams full = scene;
    full.plan = "full";
    Plan plan = plan_of(full);
    plan.start = simulation.state();
    Simulation never_slept = build_simulation(plan);
    change.make(simulation);
    change.make(never_slept);
    EXPECT_FALSE(simulation.asleep_since()) << change.name;
    const std::uint64_t steps = simulation.counters().steps;
    for (int k = 1; k <= 10; ++k)
    {
      const double time = simulation.state().time + tick;
      ASSERT_TRUE(simulation.advance_to(time));
      ASSERT_TRUE(never_slept.advance_to(time));
    }
    EXPECT_EQ(simulation.counters().steps - steps, never_slept.counters().steps) << change.name;
    EXPECT_EQ(simulation.state().positions, never_slept.state().positions) << change.name;
    EXPECT_EQ(simulation.state().velocities, never_slept.state().velocities) << change.name;
  }
}

TEST(Sleep, EndsWithoutAJumpInTheHoldOfTheStrainLimit)
{
  Simulation simulation = asleep(hanging_sheet());
  ASSERT_GT(simulation.counters().limit_sweeps, 0u);
  const Vectors shape = simulation.state().positions;
  simulation.measure_reactions(true);
  ASSERT_FALSE(simulation.asleep_since());
  for (int k = 0; k < 60; ++k)
  {
    run(simulation, tick);
    EXPECT_LT(farthest(simulation.state().positions, shape), distance);
  }
  EXPECT_FALSE(simulation.asleep_since()) << "while somebody reads the reactions";
  simulation.measure_reactions(false);
  run_until_asleep(simulation, 30.0);
  EXPECT_TRUE(simulation.asleep_since());
}

TEST(Sleep, EndsWhenPropertiesChange)
{
  SceneParams scene = stiff_sheet_without_limit();
  const Plan plan = plan_of(scene);
  Simulation simulation = asleep(scene);
  scene.sheet.structural.stiffness = 500.0;
  Simulation changed = carry_on(live_plan(plan, scene), simulation);
  EXPECT_FALSE(changed.asleep_since());
  const std::uint64_t steps = changed.counters().steps;
  run(changed, tick);
  EXPECT_GT(changed.counters().steps, steps);
}

TEST(Sleep, GoesOnWhereARequestChangesNothing)
{
  Simulation simulation = asleep(hanging_sheet());
  const Pin left = *simulation.pins().find("left");
  const double time = simulation.state().time;
  simulation.set_wind(Eigen::Vector3d::Zero());
  EXPECT_TRUE(simulation.carry("left", left.middle(time), tick));
  EXPECT_TRUE(simulation.carry("left", left.carry.placement(time), Eigen::Vector3d::Zero(), time + tick));
  EXPECT_FALSE(simulation.release("nobody"));
  EXPECT_FALSE(simulation.carry("nobody", left.middle(time), tick));
  simulation.measure_reactions(false);
  EXPECT_TRUE(simulation.asleep_since());
}

TEST(Sleep, ComesBackAfterAPinWasCarried)
{
  Simulation simulation = asleep(stiff_sheet_without_limit());
  const double first = *simulation.asleep_since();
  const Eigen::Vector3d middle = simulation.pins().find("left")->middle(simulation.state().time);
  simulation.carry("left", middle + Eigen::Vector3d(0.05, 0.0, 0.0), 1.0);
  run_until_asleep(simulation, 120.0);
  ASSERT_TRUE(simulation.asleep_since());
  EXPECT_GT(*simulation.asleep_since(), first + 2.0);
}

}  // namespace
}  // namespace cloth
