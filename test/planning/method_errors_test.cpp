// Errors that are estimated from a few long steps, against motions of much shorter ones.

#include "method_errors.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "scene/scene_text.h"

namespace cloth
{
namespace
{

StartedScene damped_sheet()
{
  const SceneParams params = scene_of(
      "{cloth: {rows: 9, cols: 9, ripple: 0.01}, air: {viscous_damping: 3, wind_coupling: 0}, strain_limit: "
      "{max_strain: 0}}");
  return { params, scene_start(params, make_sheet(params.sheet)) };
}

class MethodErrorsTest : public testing::TestWithParam<const char*>
{
protected:
  const MethodRow& row() const
  {
    return *find_method(GetParam());
  }
  Stepping stepping(double time_step) const
  {
    Stepping steps{ GetParam(), time_step };
    steps.iterations = 1;
    return steps;
  }
  double true_error(double time_step)
  {
    return distance(trials_.motion(stepping(time_step)), trials_.motion({ "rk4", first_ / 16.0 }));
  }

  StepCosts costs_{ "" };
  Trials trials_{ damped_sheet(), costs_ };
  double first_ = 0.36 * trials_.limit(*find_method("velocity_verlet"));
};

TEST_P(MethodErrorsTest, FollowFromHowTheRunsDiffer)
{
  MethodErrors errors(trials_, row().order, stepping(first_));
  errors.run_next();
  EXPECT_FALSE(errors.is_known());
  errors.run_next();
  ASSERT_TRUE(errors.is_known());
  EXPECT_FALSE(errors.falls());
  for (const double part : { 1.0, 0.5 })
  {
    const double error = true_error(part * first_);
    EXPECT_GT(errors.error_of(part * first_), 0.5 * error);
    EXPECT_LT(errors.error_of(part * first_), 4.0 * error);
  }
  errors.run_next();
  EXPECT_TRUE(errors.falls());
  EXPECT_FALSE(errors.is_at_its_floor());
  for (const double part : { 1.0, 0.5, 0.25, 0.125 })
  {
    const double error = true_error(part * first_);
    EXPECT_NEAR(errors.error_of(part * first_), error, 0.5 * error) << part;
  }
}

TEST_P(MethodErrorsTest, AgainstAReferenceAreKnownAtOnce)
{
  const Motion& exact = trials_.motion({ "rk4", first_ / 16.0 });
  MethodErrors errors(trials_, row().order, stepping(first_));
  errors.hold_against({ &exact, 0.0 });
  errors.run_next();
  ASSERT_TRUE(errors.is_known());
  EXPECT_DOUBLE_EQ(errors.error_of(first_), true_error(first_));
  EXPECT_GT(errors.error_of(0.5 * first_), 0.7 * true_error(0.5 * first_));
  EXPECT_LT(errors.error_of(0.5 * first_), 2.5 * true_error(0.5 * first_));
}

TEST_P(MethodErrorsTest, GiveTheStepForAnError)
{
  MethodErrors errors(trials_, row().order, stepping(first_));
  errors.run_next();
  errors.run_next();
  errors.run_next();
  EXPECT_EQ(errors.step_for(2.0 * errors.error_of(first_)), first_);
  for (const double part : { 0.7, 0.3, 0.1 })
  {
    const double allowed = part * errors.error_of(first_);
    EXPECT_NEAR(errors.error_of(errors.step_for(allowed)), allowed, 1e-9 * allowed) << part;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, MethodErrorsTest, testing::Values("symplectic_euler", "velocity_verlet", "xpbd"),
                         [](const testing::TestParamInfo<const char*>& info) { return std::string(info.param); });

TEST(MethodErrors, FollowFromNoRunThatWasCutOff)
{
  const SceneParams params = scene_of(
      "{cloth: {rows: 12, cols: 12, ripple: 0.01}, springs: {structural: {stiffness: 3000, damping: 0}, shear: "
      "{stiffness: "
      "3000, damping: 0}}, strain_limit: {max_strain: 0.001, sweeps: 1000, solver: sweeps}}");
  StepCosts costs("");
  Trials trials({ params, scene_start(params, make_sheet(params.sheet)) }, costs);
  Stepping stepping{ "xpbd", 0.02 };
  stepping.iterations = 1;
  MethodErrors errors(trials, 1, stepping);
  errors.run_next();
  EXPECT_LT(errors.finest().positions.size(), static_cast<size_t>(Motion::samples));
  for (int run = 0; run < 12 && (!errors.is_known() || std::isinf(errors.error_of_finest())); ++run)
  {
    errors.run_next();
  }
  EXPECT_TRUE(std::isfinite(errors.error_of_finest()));
  EXPECT_GT(errors.error_of_finest(), 0.0);
  EXPECT_FALSE(errors.falls());
}

TEST(MethodErrors, SayWhereTheMotionPartsFromItself)
{
  const SceneParams params = scene_of(
      "{cloth: {rows: 1, cols: 20, width: 0.3}, springs: {structural: {stiffness: 1000, damping: 0}, flex: {stiffness: "
      "0}}, gravity: [0, 0, -200], air: {viscous_damping: 0, wind_coupling: 0}, strain_limit: {max_strain: 0}, pins: "
      "[{name: "
      "end, nodes: [[0, 0]]}]}");
  StepCosts costs("");
  Trials trials({ params, scene_start(params, make_sheet(params.sheet)) }, costs);
  MethodErrors errors(trials, 2, { "velocity_verlet", 0.9 * trials.limit(*find_method("velocity_verlet")) });
  for (int run = 0; run < 4; ++run)
  {
    errors.run_next();
  }
  EXPECT_TRUE(errors.is_at_its_floor());
}

/// Steps far too long for stiff springs are alike in what they lose: that differs from a motion that parts from itself
/// as soon as there is something to hold them against.
TEST(MethodErrors, OfStepsThatAreAllFarTooLongAreToldByAReference)
{
  const SceneParams params = scene_of(
      "{cloth: {rows: 16, cols: 16, mass: 0.04, ripple: 0.01}, springs: {structural: {stiffness: 9000, damping: 0.5}, "
      "shear: {stiffness: 2900, damping: 0.3}, flex: {stiffness: 1600, damping: 0.2}}, air: {viscous_damping: 2, "
      "wind_coupling: 0}, strain_limit: {max_strain: 0}, pins: [{name: end, nodes: [[0, 0]]}]}");
  StepCosts costs("");
  Trials trials({ params, scene_start(params, make_sheet(params.sheet)) }, costs);
  Stepping stepping{ "xpbd", 1.0 / 16.0 };
  stepping.iterations = 1;
  MethodErrors errors(trials, 1, stepping);
  for (int run = 0; run < 3; ++run)
  {
    errors.run_next();
  }
  EXPECT_TRUE(errors.is_at_its_floor());
  const double limit = 0.9 * trials.limit(*find_method("velocity_verlet"));
  const Motion& exact = trials.motion({ "velocity_verlet", limit });
  errors.hold_against({ &exact, distance(exact, trials.motion({ "velocity_verlet", 0.5 * limit })) });
  EXPECT_FALSE(errors.is_at_its_floor());
  EXPECT_NEAR(errors.error_of_finest(), distance(errors.finest(), exact), 0.01 * errors.error_of_finest());
  const double of_long_steps = errors.error_of_finest();
  for (int run = 0; run < 4; ++run)
  {
    errors.run_next();
  }
  EXPECT_LT(errors.error_of_finest(), 0.3 * of_long_steps);
}

}  // namespace
}  // namespace cloth
