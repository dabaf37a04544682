// A limit that is asked for often follows the sheet, and is never too large.

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "cloth_sim/methods/spectrum.h"
#include "cloth_sim/simulation/stability_watch.h"
#include "support.h"

namespace cloth
{
namespace
{

class StabilityWatchTest : public testing::Test
{
protected:
  static Dynamics dynamics_of(const SceneParams& scene)
  {
    return { make_sheet(scene.sheet), scene.gravity, scene.air };
  }

  double exact_limit() const
  {
    return network_stability_limit(method_, spectrum_of(dynamics_, state_.positions));
  }
  double limit_after(std::uint64_t steps)
  {
    return watch_.limit(method_, dynamics_, state_, steps);
  }
  void stretch(double factor)
  {
    state_.positions *= factor;
  }

  const MethodRow& method_ = *find_method("velocity_verlet");
  Dynamics dynamics_ = dynamics_of(shipped_scene("free_sheet"));
  ClothState state_{ dynamics_.model().rest_positions, Vectors::Zero(dynamics_.model().nodes(), 3), 0.0 };
  StabilityWatch watch_;
};

TEST_F(StabilityWatchTest, IsExactAtFirstAndWhenItWasForgotten)
{
  EXPECT_DOUBLE_EQ(limit_after(0), exact_limit());
  stretch(2.0);
  watch_.forget();
  EXPECT_DOUBLE_EQ(limit_after(1), exact_limit());
}

TEST_F(StabilityWatchTest, LooksAgainSoonAtFirst)
{
  const double before = limit_after(0);
  stretch(2.0);
  EXPECT_EQ(limit_after(7), before);
  EXPECT_LT(limit_after(8), 0.95 * before);
}

TEST_F(StabilityWatchTest, LooksSeldomWhereNothingChangesAndOftenWhereSomethingDoes)
{
  const double before = limit_after(0);
  std::uint64_t steps = 0;
  for (const std::uint64_t looks : { 16, 32, 64, 64 })
  {
    steps += watch_.steps_between_looks();
    EXPECT_EQ(limit_after(steps), before);
    EXPECT_EQ(watch_.steps_between_looks(), looks);
  }
  stretch(1.3);
  EXPECT_EQ(limit_after(steps + 63), before);
  EXPECT_LT(limit_after(steps + 64), before);
  EXPECT_EQ(watch_.steps_between_looks(), 8);
}

/// As often as bounds change by a fiftieth.
TEST_F(StabilityWatchTest, LooksAsOftenAsTheSheetChanges)
{
  Noise noise;
  state_.positions += 0.01 * noise.vectors(dynamics_.model().nodes());
  stretch(1.2);
  limit_after(0);
  std::uint64_t steps = 0;
  for (int look = 0; look < 20; ++look)
  {
    const std::uint64_t until = steps + watch_.steps_between_looks();
    for (; steps < until; ++steps)
    {
      stretch(1.003);
    }
    EXPECT_LE(limit_after(steps), 1.01 * exact_limit()) << look;
  }
  const SpectrumBounds before = spectrum_bounds(dynamics_, state_.positions);
  stretch(std::pow(1.003, watch_.steps_between_looks()));
  const double change = spectrum_bounds(dynamics_, state_.positions).stiffness / before.stiffness - 1.0;
  EXPECT_GT(change, 0.005);
  EXPECT_LT(change, 0.03);
}

TEST_F(StabilityWatchTest, OfTheBoundIsNeitherTooLargeNorFarTooSmall)
{
  limit_after(0);
  Noise noise;
  state_.positions += 0.01 * noise.vectors(dynamics_.model().nodes());
  stretch(2.0);
  const double of_bound = limit_after(64);
  EXPECT_LE(of_bound, exact_limit());
  EXPECT_GE(of_bound, 0.75 * exact_limit());
}

TEST_F(StabilityWatchTest, IsWorkedOutFromTheSpectrumAgainAfter512Steps)
{
  limit_after(0);
  Noise noise;
  state_.positions += 0.01 * noise.vectors(dynamics_.model().nodes());
  stretch(2.0);
  limit_after(64);
  EXPECT_DOUBLE_EQ(limit_after(64 + 512), exact_limit());
}

TEST_F(StabilityWatchTest, GrowsAgainWhereTheSheetIsSlackAgain)
{
  const double slack = limit_after(0);
  stretch(2.0);
  const double taut = limit_after(64);
  EXPECT_LT(taut, 0.85 * slack);
  EXPECT_LE(taut, exact_limit());
  stretch(0.5);
  EXPECT_GT(limit_after(128), 0.8 * slack);
}

/// A chain whose damped springs are at right angles to each other, and undamped springs from every node to the next but
/// one. Pulled straight, it is twice as damped and no stiffer.
TEST(StabilityWatchOfADampedChain, SeesThatItHasUnfolded)
{
  SheetProperties sheet = chain(9, 1.0, 0.01);
  sheet.structural.damping = 1.0;
  sheet.flex = { 50.0, 0.0 };
  const Dynamics dynamics(make_sheet(sheet), Eigen::Vector3d::Zero(), vacuum());
  const Vectors& straight = dynamics.model().rest_positions;
  ClothState state{ std::sqrt(0.5) * straight, Vectors::Zero(9, 3), 0.0 };
  for (int node = 0; node < 9; node += 2)
  {
    state.positions(node, 0) += std::sqrt(0.5) * 0.125;
  }
  const MethodRow& method = *find_method("velocity_verlet");
  StabilityWatch watch;
  const double folded = watch.limit(method, dynamics, state, 0);
  const double stiffness_folded = spectrum_bounds(dynamics, state.positions).stiffness;
  state.positions = straight;
  EXPECT_LE(spectrum_bounds(dynamics, straight).stiffness, 1.05 * stiffness_folded);
  const double unfolded = watch.limit(method, dynamics, state, 64);
  EXPECT_LE(unfolded, network_stability_limit(method, spectrum_of(dynamics, straight)));
  EXPECT_LT(unfolded, 0.6 * folded);
}

/// What is stiff or damped stays so however the sheet is turned.
TEST_F(StabilityWatchTest, StaysWhileTheSheetTurnsAsAWhole)
{
  Noise noise;
  state_.positions += 0.03 * noise.vectors(dynamics_.model().nodes());
  const double before = limit_after(0);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  for (std::uint64_t look = 1; look <= 20; ++look)
  {
    state_.positions = state_.positions * turn;
    state_.time += 0.1;
    EXPECT_EQ(limit_after(64 * look), before);
  }
}

TEST_F(StabilityWatchTest, AsksNoMoreWhereNoShapeOfTheSheetIsUnstable)
{
  const double enough = 0.5 * exact_limit();
  const double of_any_shape = watch_.limit(method_, dynamics_, state_, 0, enough);
  EXPECT_GE(of_any_shape, enough);
  EXPECT_LE(of_any_shape, exact_limit());
  Noise noise;
  state_.positions += 0.03 * noise.vectors(dynamics_.model().nodes());
  stretch(10.0);
  EXPECT_EQ(watch_.limit(method_, dynamics_, state_, 1000, enough), of_any_shape);
  EXPECT_LE(of_any_shape, exact_limit());
}

TEST_F(StabilityWatchTest, IsContentWithTheBoundWhereThatIsEnough)
{
  Noise noise;
  state_.positions += 0.02 * noise.vectors(dynamics_.model().nodes());
  const SpectrumBounds bounds = spectrum_bounds(dynamics_, state_.positions);
  const double of_bounds = network_stability_limit(method_, spectrum_of(dynamics_, state_.positions, bounds));
  EXPECT_EQ(watch_.limit(method_, dynamics_, state_, 0, of_bounds), of_bounds);
  watch_.forget();
  EXPECT_EQ(watch_.limit(method_, dynamics_, state_, 0, 1.001 * of_bounds), exact_limit());
}

/// Steps that change shake a sheet that hangs in its strain limit.
TEST_F(StabilityWatchTest, StaysWhileNoNodeIsHeldMuchStiffer)
{
  stretch(1.02);
  const double before = limit_after(0);
  stretch(1.01);
  for (std::uint64_t look = 1; look <= 20; ++look)
  {
    state_.time += 0.1;
    EXPECT_EQ(limit_after(64 * look), before);
  }
  stretch(1.2);
  EXPECT_NE(limit_after(64 * 21), before);
}

/// A soft sheet of few nodes that is let go changes much in 64 steps.
TEST(StabilityWatchOfARun, KeepsStepsWithinTheLimitWhileASheetIsPulledFromRest)
{
  SceneParams scene = shipped_scene("hanging_sheet");
  scene.sheet.rows = 8;
  scene.sheet.cols = 14;
  scene.sheet.structural = { 200.0, 0.0 };
  scene.sheet.shear = { 0.0, 0.0 };
  scene.sheet.flex = { 7.0, 0.0 };
  scene.sheet.mass = 0.3;
  scene.strain_limit.max_strain = 0.0;
  scene.solver.method = "velocity_verlet";
  Simulation simulation = build_simulation(make_plan(scene));
  double most = 0.0;
  double time_before = 0.0;
  std::uint64_t steps_before = 0;
  const auto look = [&] {
    const std::uint64_t steps = simulation.counters().steps;
    if (steps > steps_before)
    {
      const double h = (simulation.state().time - time_before) / static_cast<double>(steps - steps_before);
      const Spectrum spectrum = spectrum_of(simulation.dynamics(), simulation.state().positions);
      most = std::max(most, h / network_stability_limit(simulation.method(), spectrum));
    }
    time_before = simulation.state().time;
    steps_before = steps;
    return false;
  };
  for (int eighth = 1; eighth <= 8; ++eighth)
  {
    simulation.advance_to(eighth / 8.0, look);
    look();
  }
  EXPECT_GT(most, 0.85);
  EXPECT_LT(most, 0.96);
}

}  // namespace
}  // namespace cloth
