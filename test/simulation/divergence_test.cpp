#include <cmath>

#include <gtest/gtest.h>

#include "cloth_sim/simulation/divergence_guard.h"
#include "support.h"

namespace cloth
{
namespace
{

class Divergence : public testing::TestWithParam<MethodRow>
{
};

/// The methods that a step beyond their limit blows up.
std::vector<MethodRow> explosive_methods()
{
  std::vector<MethodRow> rows;
  for (const MethodRow& row : methods())
  {
    if (!row.is_adaptive && std::isfinite(row.stability_limit({ 1.0, 0.0, 0.0 })))
    {
      rows.push_back(row);
    }
  }
  return rows;
}

INSTANTIATE_TEST_SUITE_P(Methods, Divergence, testing::ValuesIn(explosive_methods()), name_of_method);

/// `times` the true limit. Where the air has to pay for an undamped method, the claimed one is far below that.
SceneParams scene_beyond_the_limit(const std::string& method, double times)
{
  times *= method == "explicit_euler" ? 50.0 : method == "midpoint" ? 3.0 : 1.0;
  SceneParams scene = shipped_scene("hanging_sheet");
  scene.sheet.rows = scene.sheet.cols = 10;
  scene.strain_limit.max_strain = 0.0;
  scene.solver.method = method;
  scene.solver.time_step = times * build_simulation(make_plan(scene)).stability_limit();
  return scene;
}

TEST_P(Divergence, IsCaughtWithTheLastGoodStateKept)
{
  for (const double times : { 1.2, 3.0, 1000.0 })
  {
    Simulation simulation = build_simulation(make_plan(scene_beyond_the_limit(GetParam().name, times)));
    double reached = 0.0;
    for (int k = 1; k <= 300 && simulation.advance_to(0.0333 * k); ++k)
    {
      reached = simulation.state().time;
    }
    ASSERT_TRUE(simulation.divergence().has_value()) << times << " times the limit";
    EXPECT_GE(simulation.divergence()->time, reached);
    EXPECT_LE(simulation.state().time, simulation.divergence()->time);
    EXPECT_TRUE(simulation.state().positions.allFinite());
    // No node is farther away than the sheet could have fallen or been flung.
    EXPECT_LT(simulation.state().positions.cwiseAbs().maxCoeff(), 10.0);
  }
}

TEST_P(Divergence, EndsTheRun)
{
  Simulation simulation = build_simulation(make_plan(scene_beyond_the_limit(GetParam().name, 3.0)));
  EXPECT_FALSE(simulation.advance_to(5.0));
  const ClothState kept = simulation.state();
  EXPECT_FALSE(simulation.advance_to(6.0));
  EXPECT_EQ(simulation.state().positions, kept.positions);
  EXPECT_EQ(simulation.state().time, kept.time);
}

TEST_P(Divergence, ReportSaysWhenWhereTheLimitAndWhatToChange)
{
  Simulation simulation = build_simulation(make_plan(scene_beyond_the_limit(GetParam().name, 1.2)));
  EXPECT_TRUE(simulation.divergence_report().empty());
  simulation.advance_to(5.0);
  const std::string report = simulation.divergence_report();
  for (const char* const part :
       { "diverged at ", "node [", "energy of ", "stability limit", GetParam().name, "solver.time_step" })
  {
    EXPECT_NE(report.find(part), std::string::npos) << part << " is not in: " << report;
  }
}

TEST_P(Divergence, ReportGivesTheStepThatWasTakenAndNotALongerOneThatWasAllowed)
{
  SceneParams scene = scene_beyond_the_limit(GetParam().name, 3.0);
  scene.solver.time_step = 1.0;
  Simulation simulation = build_simulation(make_plan(scene));
  for (int k = 1; simulation.advance_to(0.03 * k); ++k)
  {
  }
  EXPECT_NE(simulation.divergence_report().find("the step was 0.03 s"), std::string::npos)
      << simulation.divergence_report();
}

class ShippedSceneGuarded : public testing::TestWithParam<std::string>
{
};

INSTANTIATE_TEST_SUITE_P(All, ShippedSceneGuarded, testing::ValuesIn(shipped_scenes));

TEST_P(ShippedSceneGuarded, IsNotTakenForDiverged)
{
  SceneParams scene = shipped_scene(GetParam());
  scene.sheet.rows = std::min(scene.sheet.rows, 16);
  scene.strain_limit.max_strain = 0.0;
  for (PinParams& pin : scene.pins)
  {
    pin.motion = { { 0.1, 0.2, 0.1 }, 2.0, 0.3 };
  }
  Simulation simulation = build_simulation(make_plan(scene));
  EXPECT_TRUE(simulation.advance_to(3.0)) << simulation.divergence_report();
}

TEST(DivergenceGuard, TakesAFallAGustAndAPullForWhatTheyAre)
{
  SimulationSetup setup = springs_alone(small_sheet(), "velocity_verlet", 0.0);
  setup.gravity = { 0.0, 0.0, -9.81 };
  setup.air = { 0.0, 5.0, Eigen::Vector3d::Zero(), {} };
  setup.pins.push_back(still_pin("hand", { 0 }, setup.start.positions));
  Simulation simulation(setup);
  EXPECT_TRUE(simulation.advance_to(0.5));
  simulation.set_wind({ 0.0, 40.0, 0.0 });
  EXPECT_TRUE(simulation.advance_to(1.0)) << simulation.divergence_report();
  ASSERT_TRUE(simulation.carry("hand", { 2.0, 1.0, 1.0 }, 0.1));
  EXPECT_TRUE(simulation.advance_to(2.0)) << simulation.divergence_report();
  simulation.release_all();
  EXPECT_TRUE(simulation.advance_to(12.0)) << simulation.divergence_report();
}

TEST(DivergenceGuard, NamesANodeThatIsNotFinite)
{
  const Dynamics dynamics(make_sheet(small_sheet()), Eigen::Vector3d::Zero(), vacuum());
  ClothState state{ dynamics.model().rest_positions, Vectors::Zero(dynamics.model().nodes(), 3), 0.25 };
  DivergenceGuard guard;
  guard.open(dynamics, state);
  EXPECT_FALSE(guard.check(dynamics, state).has_value());
  state.velocities(7, 1) = std::numeric_limits<double>::quiet_NaN();
  ASSERT_TRUE(guard.check(dynamics, state).has_value());
  EXPECT_EQ(guard.check(dynamics, state)->node, 7);
  EXPECT_EQ(guard.check(dynamics, state)->time, 0.25);
}

}  // namespace
}  // namespace cloth
