#include "cloth_sim/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "cloth_sim/forces/springs.h"
#include "cloth_sim/threads/crew.h"
#include "support.h"

namespace cloth
{
namespace
{

SceneParams small_hanging_sheet()
{
  SceneParams scene = shipped_scene("hanging_sheet");
  scene.sheet.rows = scene.sheet.cols = 12;
  scene.solver.method = "velocity_verlet";
  return scene;
}

Simulation simulation_of(const SceneParams& scene)
{
  return build_simulation(make_plan(scene));
}

TEST(Simulation, TakesTheFewestEqualStepsToATime)
{
  SceneParams scene = small_hanging_sheet();
  scene.solver.time_step = 1e-3;
  Simulation simulation = simulation_of(scene);
  simulation.advance_to(0.0105);
  EXPECT_EQ(simulation.counters().steps, 11u);
  EXPECT_EQ(simulation.state().time, 0.0105);
  simulation.advance_to(0.0205);
  EXPECT_EQ(simulation.counters().steps, 21u) << "a rounding error must not make a step of its own";
  simulation.advance_to(0.0205);
  EXPECT_EQ(simulation.counters().steps, 21u);
}

TEST(Simulation, HasAThreadForEvery2048NodesAndNotMoreThanTheSceneAllows)
{
  const auto threads_of = [](int rows, int given) {
    SceneParams scene = small_hanging_sheet();
    scene.sheet.rows = rows;
    scene.sheet.cols = 64;
    scene.solver.threads = given;
    return simulation_of(scene).dynamics().threads();
  };
  EXPECT_EQ(threads_of(63, 8), 1);
  EXPECT_EQ(threads_of(64, 8), 2);
  EXPECT_EQ(threads_of(96, 8), 3);
  EXPECT_EQ(threads_of(96, 2), 2);
  EXPECT_EQ(threads_of(96, 1), 1);
  EXPECT_EQ(threads_of(96, 0), std::min(2, usable_threads()));
  EXPECT_EQ(threads_of(32, 0), 1);
}

TEST(Simulation, TakesNineTenthsOfTheLimitWhereNoStepIsGiven)
{
  Simulation simulation = simulation_of(small_hanging_sheet());
  EXPECT_DOUBLE_EQ(simulation.time_step(), 0.9 * simulation.stability_limit());
}

TEST(Simulation, TakesAFixedStepWhereThereIsNoLimit)
{
  SceneParams scene = small_hanging_sheet();
  scene.sheet.structural.stiffness = scene.sheet.shear.stiffness = scene.sheet.flex.stiffness = 0.0;
  const Simulation simulation = simulation_of(scene);
  EXPECT_TRUE(std::isinf(simulation.stability_limit()));
  EXPECT_DOUBLE_EQ(simulation.time_step(), 1.0 / 240.0);
}

TEST(Simulation, ShortensItsStepsAsTheSheetStiffens)
{
  SimulationSetup setup = springs_alone(small_sheet(), "velocity_verlet", 0.0);
  setup.pins = { still_pin("left", { 0, 6, 12, 18, 24 }, setup.start.positions),
                 still_pin("right", { 5, 11, 17, 23, 29 }, setup.start.positions) };
  Simulation simulation(setup);
  const double before = simulation.time_step();
  simulation.carry("right", { 0.85, 0.0, -0.15 }, 0.4);
  ASSERT_TRUE(simulation.advance_to(1.0)) << simulation.divergence_report();
  EXPECT_GT(max_strain(simulation.model(), simulation.state().positions), 1.0);
  EXPECT_LT(simulation.time_step(), 0.95 * before);
  EXPECT_LE(simulation.time_step(), simulation.stability_limit());
}

TEST(Simulation, OfTheSameSceneHasTheSameBits)
{
  Simulation one = simulation_of(small_hanging_sheet());
  Simulation other = simulation_of(small_hanging_sheet());
  for (int k = 1; k <= 30; ++k)
  {
    one.advance_to(0.0333 * k);
    other.advance_to(0.0333 * k);
  }
  EXPECT_EQ(one.state().positions, other.state().positions);
  EXPECT_EQ(one.state().velocities, other.state().velocities);
}

TEST(Simulation, InGustsOfTheSameSeedHasTheSameBits)
{
  SceneParams scene = small_hanging_sheet();
  scene.air.gusts = { 3.0, 0.2, 4 };
  Simulation one = simulation_of(scene);
  Simulation again = simulation_of(scene);
  scene.air.gusts.seed = 5;
  Simulation other = simulation_of(scene);
  for (Simulation* const simulation : { &one, &again, &other })
  {
    simulation->advance_to(0.5);
  }
  EXPECT_EQ(one.state().positions, again.state().positions);
  EXPECT_GT((one.state().positions - other.state().positions).cwiseAbs().maxCoeff(), 0.01);
}

TEST(Simulation, InGustsSeesTheWindOfEveryMoment)
{
  // A light sheet that the air takes along goes as the wind does, a millisecond late: its way is the gusts' integral.
  SceneParams scene = small_hanging_sheet();
  scene.gravity.setZero();
  scene.pins.clear();
  scene.start.ripple = 0.0;
  scene.start.initial_stretch.setOnes();
  scene.sheet.mass = 1e-2;
  scene.sheet.structural.stiffness = scene.sheet.shear.stiffness = scene.sheet.flex.stiffness = 0.0;
  scene.air = { 0.0, 10.0, Eigen::Vector3d::Zero(), { 0.2, 0.5, 3 } };
  scene.solver.method = "dopri5";
  scene.solver.tolerance = 1e-6;
  Simulation simulation = simulation_of(scene);
  ASSERT_TRUE(simulation.advance_to(1.0)) << simulation.divergence_report();
  const Gusts gusts(scene.air.gusts);
  double way = 0.0;
  constexpr int parts = 10000;
  for (int k = 0; k < parts; ++k)
  {
    way += gusts.at((k + 0.5) / parts).y() / parts;
  }
  EXPECT_GT(std::abs(way), 0.01);
  EXPECT_NEAR(simulation.state().positions.col(1).mean(), way, 1e-3);
}

TEST(Simulation, LeavesTheLimitAloneWhereItIsOff)
{
  SceneParams scene = small_hanging_sheet();
  scene.strain_limit.max_strain = 0.0;
  Simulation simulation = simulation_of(scene);
  simulation.advance_to(1.0);
  EXPECT_EQ(simulation.counters().limit_sweeps, 0u);
}

class EveryMethodInASimulation : public testing::TestWithParam<MethodRow>
{
protected:
  /// Wind, drag, damping, the strain limit, a pin that stays and one that moves.
  static Simulation everything_at_once()
  {
    SceneParams scene = small_hanging_sheet();
    scene.solver.method = GetParam().name;
    scene.solver.time_step = GetParam().linear_solves > 0 || GetParam().order == 1 ? 5e-4 : 0.0;
    // Explicit Euler is stable at this step while damping pays for it.
    scene.sheet.structural.damping = scene.sheet.shear.damping = 0.1;
    scene.sheet.flex.damping = 0.01;
    scene.strain_limit.sweeps = 300;
    scene.air.wind = { 1.0, 3.0, 0.0 };
    scene.pins[1].motion = { { 0.0, 0.1, 0.05 }, 1.0, 0.0 };
    return simulation_of(scene);
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethodInASimulation, testing::ValuesIn(methods()), name_of_method);

TEST_P(EveryMethodInASimulation, ObeysTheStrainLimitAndItsPinsInWind)
{
  Simulation simulation = everything_at_once();
  const Vectors start = simulation.state().positions;
  double worst = 0.0;
  for (int k = 1; k <= 30; ++k)
  {
    ASSERT_TRUE(simulation.advance_to(0.04 * k)) << simulation.divergence_report();
    worst = std::max(worst, max_strain(simulation.model(), simulation.state().positions));
  }
  EXPECT_GT(worst, 0.09);
  EXPECT_LT(worst, 0.1001);
  EXPECT_GT(simulation.counters().limit_sweeps, simulation.counters().steps / 10);
  const double angle = 2.0 * M_PI * simulation.state().time;
  const Eigen::RowVector3d moved = std::sin(angle) * Eigen::RowVector3d(0.0, 0.1, 0.05);
  EXPECT_EQ(simulation.state().positions.row(0), start.row(0));
  EXPECT_LT((simulation.state().positions.row(11) - start.row(11) - moved).norm(), 1e-14);
}

TEST_P(EveryMethodInASimulation, HasTheSameBitsEveryTime)
{
  Simulation one = everything_at_once();
  Simulation other = everything_at_once();
  for (int k = 1; k <= 10; ++k)
  {
    one.advance_to(0.0333 * k);
    other.advance_to(0.0333 * k);
  }
  EXPECT_EQ(one.state().positions, other.state().positions);
  EXPECT_EQ(one.state().velocities, other.state().velocities);
}

TEST(Simulation, CountsTheCostOfAStepThatTheTableClaims)
{
  for (const MethodRow& row : methods())
  {
    SceneParams scene = small_hanging_sheet();
    scene.strain_limit.max_strain = 0.0;
    scene.solver.method = row.name;
    scene.solver.time_step = row.is_adaptive ? 1e-3 : 0.0;
    scene.solver.tolerance = 1e6;
    scene.solver.iterations = 1;
    Simulation simulation = simulation_of(scene);
    simulation.advance_to(0.2);
    const double steps = static_cast<double>(simulation.counters().steps);
    const double evaluations = static_cast<double>(simulation.counters().force_evaluations) / steps;
    const double solves = static_cast<double>(simulation.counters().linear_solves) / steps;
    SCOPED_TRACE(row.name);
    if (row.linear_solves == 0)
    {
      EXPECT_NEAR(evaluations, row.force_evaluations, 0.1);
      EXPECT_EQ(solves, 0.0);
    }
    else
    {
      EXPECT_GE(evaluations, row.force_evaluations);
      EXPECT_GE(solves, row.linear_solves);
      EXPECT_LT(evaluations, 10.0 * row.force_evaluations);
    }
  }
}

TEST(Simulation, HoldsNodesWhereTheyAreAndLetsThemGo)
{
  Simulation simulation = simulation_of(small_hanging_sheet());
  simulation.advance_to(0.3);
  const Eigen::RowVector3d held = simulation.state().positions.row(140);
  simulation.hold("hand", { 140 });
  simulation.advance_to(0.6);
  EXPECT_EQ(simulation.state().positions.row(140), held);
  EXPECT_TRUE(simulation.release("hand"));
  EXPECT_FALSE(simulation.release("hand"));
  simulation.advance_to(0.9);
  EXPECT_GT((simulation.state().positions.row(140) - held).norm(), 1e-3);
}

TEST(Simulation, CarriesAPinWithinTheTimeGiven)
{
  Simulation simulation = simulation_of(small_hanging_sheet());
  ASSERT_TRUE(simulation.carry("left", { -0.3, 0.2, 1.6 }, 0.1));
  EXPECT_FALSE(simulation.carry("nobody", { 0.0, 0.0, 0.0 }, 0.1));
  simulation.advance_to(0.1);
  EXPECT_TRUE(simulation.state().positions.row(0).isApprox(Eigen::RowVector3d(-0.3, 0.2, 1.6), 1e-12));
}

TEST(Simulation, TurnsAPinAsARigidBodyUpToAMomentOfEveryMethod)
{
  for (const MethodRow& row : methods())
  {
    SCOPED_TRACE(row.name);
    SceneParams scene = small_hanging_sheet();
    scene.solver.method = row.name;
    scene.pins = { { "edge", "top_edge", {}, {} } };
    Simulation simulation = simulation_of(scene);
    const Vectors held = simulation.pins().find("edge")->held;
    constexpr double tick = 1.0 / 30.0;
    Eigen::Isometry3d placement = Eigen::Isometry3d::Identity();
    placement.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()));
    for (int k = 1; k <= 3; ++k)
    {
      const double end = k * tick;
      placement.pretranslate(Eigen::Vector3d(0.0, 0.01, 0.02));
      ASSERT_TRUE(simulation.carry("edge", placement, Eigen::Vector3d::Zero(), end));
      ASSERT_TRUE(simulation.advance_to(end)) << simulation.divergence_report();
      const Eigen::RowVector3d turning = Eigen::RowVector3d(0.0, 0.0, k == 1 ? 0.1 / tick : 0.0);
      const Eigen::RowVector3d rising = Eigen::RowVector3d(0.0, 0.01, 0.02) / tick;
      for (int i = 0; i < held.rows(); ++i)
      {
        const Eigen::RowVector3d arm = (placement.linear() * held.row(i).transpose()).transpose();
        const Eigen::RowVector3d place = arm + placement.translation().transpose();
        EXPECT_LT((simulation.state().positions.row(i) - place).norm(), 1e-13) << "node " << i << ", tick " << k;
        EXPECT_LT((simulation.state().velocities.row(i) - turning.cross(arm) - rising).norm(), 1e-11)
            << "node " << i << ", tick " << k;
      }
    }
    const Eigen::RowVector3d let_go = simulation.state().velocities.row(3);
    simulation.release("edge");
    EXPECT_EQ(simulation.state().velocities.row(3), let_go);
  }
  Simulation simulation = simulation_of(small_hanging_sheet());
  EXPECT_FALSE(simulation.carry("nobody", Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero(), 0.1));
}

TEST(Simulation, WindSetOnTheWayBlowsFromThenOn)
{
  Simulation simulation = simulation_of(small_hanging_sheet());
  simulation.advance_to(1.0);
  const double before = simulation.state().positions.col(1).mean();
  simulation.set_wind({ 0.0, 4.0, 0.0 });
  simulation.advance_to(2.0);
  EXPECT_GT(simulation.state().positions.col(1).mean(), before + 0.1);
}

TEST(Simulation, StopsOnTheWayWhenItIsToldToAndGoesOnFromThere)
{
  Simulation simulation = simulation_of(small_hanging_sheet());
  int asked = 0;
  EXPECT_TRUE(simulation.advance_to(1.0, [&] { return ++asked == 3; }));
  EXPECT_EQ(asked, 3);
  const double reached = simulation.state().time;
  EXPECT_GT(reached, 0.0);
  EXPECT_LT(reached, 1.0);
  EXPECT_FALSE(simulation.divergence());
  EXPECT_TRUE(simulation.advance_to(1.0, [] { return false; }));
  EXPECT_EQ(simulation.state().time, 1.0);
}

/// The cloth after 0.4 s, with a hand that has begun to carry a node.
Simulation cloth_in_motion()
{
  Simulation simulation = simulation_of(small_hanging_sheet());
  simulation.advance_to(0.3);
  simulation.hold("hand", { 140 });
  simulation.carry("hand", { 0.1, 0.3, 1.0 }, 0.2);
  simulation.advance_to(0.4);
  return simulation;
}

SimulationSetup other_properties()
{
  SceneParams scene = small_hanging_sheet();
  SimulationSetup setup;
  setup.model = make_sheet(scene.sheet);
  setup.gravity = { 0.0, 1.0, -5.0 };
  setup.method = find_method("symplectic_euler");
  setup.start.positions = setup.start.velocities = Vectors::Zero(setup.model.nodes(), 3);
  return setup;
}

TEST(Simulation, GoesOverToOtherPropertiesWithoutAJerk)
{
  const Simulation before = cloth_in_motion();
  Simulation after = before.gone_over_to(other_properties());
  EXPECT_EQ(after.state().positions, before.state().positions);
  EXPECT_EQ(after.state().velocities, before.state().velocities);
  EXPECT_EQ(after.state().time, before.state().time);
  EXPECT_EQ(after.counters().steps, before.counters().steps);
  EXPECT_EQ(after.dynamics().gravity(), Eigen::Vector3d(0.0, 1.0, -5.0));
  EXPECT_STREQ(after.method().name, "symplectic_euler");
  ASSERT_EQ(after.pins().all().size(), 3u);
  ASSERT_TRUE(after.advance_to(0.5));
  EXPECT_TRUE(after.state().positions.row(140).isApprox(Eigen::RowVector3d(0.1, 0.3, 1.0), 1e-12))
      << "the hand gets where it was sent";
}

TEST(Simulation, GoneOverToWhatItIsItMovesAsIfNothingHadHappened)
{
  SceneParams scene = small_hanging_sheet();
  scene.strain_limit.max_strain = 0.02;
  scene.solver.time_step = 5e-4;
  Simulation simulation = simulation_of(scene);
  simulation.advance_to(0.3);
  Simulation same = carry_on(make_plan(scene), simulation);
  simulation.advance_to(0.4);
  same.advance_to(0.4);
  EXPECT_GT(simulation.counters().limit_sweeps, simulation.counters().steps / 10);
  EXPECT_LT((same.state().positions - simulation.state().positions).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Simulation, ALowerStrainLimitGivesNoSpeed)
{
  SceneParams scene = small_hanging_sheet();
  scene.strain_limit.max_strain = 0.0;
  Simulation simulation = simulation_of(scene);
  simulation.advance_to(0.5);
  ASSERT_GT(max_strain(simulation.model(), simulation.state().positions), 0.03);
  SimulationSetup setup = other_properties();
  setup.strain_limit = { 0.02, 30 };
  setup.time_step = 1e-5;
  Simulation limited = simulation.gone_over_to(setup);
  EXPECT_LT(max_strain(limited.model(), limited.state().positions), 0.0205);
  EXPECT_EQ(limited.state().velocities, simulation.state().velocities);
  EXPECT_TRUE(limited.advance_to(0.51)) << limited.divergence_report();
}

TEST(Simulation, GoneOverItKeepsAGivenStepWithinTheLimit)
{
  const Simulation before = cloth_in_motion();
  SimulationSetup setup = other_properties();
  setup.time_step = 1.0;
  const Simulation stiff = before.gone_over_to(setup);
  EXPECT_NEAR(stiff.time_step(), Simulation::limit_share * stiff.stability_limit(), 1e-3 * stiff.stability_limit());
  setup.time_step = 0.5 * stiff.stability_limit();
  EXPECT_EQ(before.gone_over_to(setup).time_step(), setup.time_step);
}

TEST(Simulation, GoneOverItIsStillDiverged)
{
  SceneParams scene = small_hanging_sheet();
  scene.solver.method = "symplectic_euler";
  scene.solver.time_step = 0.02;
  scene.strain_limit.max_strain = 0.0;
  Simulation simulation = simulation_of(scene);
  ASSERT_FALSE(simulation.advance_to(5.0));
  Simulation other = simulation.gone_over_to(other_properties());
  EXPECT_TRUE(other.divergence());
  EXPECT_FALSE(other.advance_to(6.0));
}

TEST(Simulation, OscillatingPinsAreWhereTheFormulaPutsThem)
{
  for (const MethodRow& row : methods())
  {
    SceneParams scene = small_hanging_sheet();
    scene.solver.method = row.name;
    scene.pins[1].motion = { { 0.05, 0.1, 0.0 }, 1.5, 0.7 };
    Simulation simulation = simulation_of(scene);
    const Eigen::Vector3d start = simulation.state().positions.row(11);
    simulation.advance_to(0.77);
    const Eigen::Vector3d exact = start + scene.pins[1].motion.displacement(0.77);
    EXPECT_TRUE(simulation.state().positions.row(11).transpose().isApprox(exact, 1e-14)) << row.name;
    EXPECT_TRUE(simulation.state().velocities.row(11).transpose().isApprox(scene.pins[1].motion.velocity(0.77), 1e-12))
        << row.name;
  }
}

TEST(Simulation, WithoutAMethodOrWithAStartThatDoesNotFitIsRefused)
{
  EXPECT_THROW(Simulation(springs_alone(small_sheet(), "no_such_method", 0.0)), std::invalid_argument);
  SimulationSetup setup = springs_alone(small_sheet(), "rk4", 0.0);
  setup.start.velocities.resize(3, 3);
  EXPECT_THROW(Simulation{ setup }, std::invalid_argument);
}

TEST(Simulation, RunsALargeSheet)
{
  SceneParams scene = shipped_scene("hanging_sheet");
  scene.sheet.rows = scene.sheet.cols = 128;
  Simulation simulation = simulation_of(scene);
  EXPECT_TRUE(simulation.advance_to(0.1)) << simulation.divergence_report();
}

}  // namespace
}  // namespace cloth
