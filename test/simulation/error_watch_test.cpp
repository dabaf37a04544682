// Checks of what steps err by, against motions of much shorter steps, and what they make of the steps.

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cloth_sim/scene/pin_selection.h"
#include "cloth_sim/simulation/simulation.h"
#include "scene/scene_text.h"
#include "support.h"

namespace cloth
{
namespace
{

constexpr double tick = 1.0 / 16.0;
constexpr double check_begin = ErrorWatch::first_check;
constexpr double check_end = check_begin + ErrorWatch::horizon;

/// Kept in motion by a pin, and damped, so that there is a motion to be wrong about.
const char* const shaken_sheet =
    "{cloth: {rows: 6, cols: 6, ripple: 0.01}, air: {viscous_damping: 1}, strain_limit: {max_strain: 0}, pins: [{name: "
    "left, nodes: [[0, 0]]}, {name: right, nodes: [[0, 5]], motion: {amplitude: [0, 0.1, 0], frequency: 1}}]}";

SimulationSetup setup_of(const std::string& yaml, const std::string& method, double time_step)
{
  const SceneParams scene = scene_of(yaml);
  SimulationSetup setup;
  setup.model = make_sheet(scene.sheet);
  setup.gravity = scene.gravity;
  setup.air = scene.air;
  setup.strain_limit = scene.strain_limit;
  setup.method = find_method(method);
  setup.method_settings.iterations = 1;
  setup.time_step = time_step;
  setup.keeps_within_limit = true;
  setup.start = scene_start(scene, setup.model).state;
  setup.pins = pins_of(scene.pins, setup.model, setup.start.positions);
  return setup;
}

SimulationSetup shaken(double time_step)
{
  return setup_of(shaken_sheet, "xpbd", time_step);
}

void run(Simulation& simulation, double end)
{
  const auto done = static_cast<int>(std::lround(simulation.state().time / tick));
  for (int k = done + 1; k * tick <= end; ++k)
  {
    ASSERT_TRUE(simulation.advance_to(k * tick)) << simulation.divergence_report();
  }
}

/// Of what follows from the same state as at the beginning of the first check, by the same method.
double true_error(SimulationSetup setup)
{
  setup.error_bounds = {};
  Simulation coarse(setup);
  run(coarse, check_begin);
  setup.start = coarse.state();
  setup.time_step /= 64.0;
  Simulation fine(setup);
  double squares = 0.0;
  for (int s = 1; s <= ErrorWatch::samples; ++s)
  {
    const double time = check_begin + ErrorWatch::horizon * s / ErrorWatch::samples;
    run(coarse, time);
    run(fine, time);
    squares +=
        (coarse.state().positions - fine.state().positions).squaredNorm() / static_cast<double>(coarse.model().nodes());
  }
  return std::sqrt(squares / ErrorWatch::samples);
}

constexpr double step = tick / 32.0;

TEST(ErrorWatch, FindsWhatTheStepsErrBy)
{
  for (const std::string method : { "xpbd", "symplectic_euler", "velocity_verlet" })
  {
    SimulationSetup setup = setup_of(shaken_sheet, method, step);
    setup.error_bounds = { 1.0, 1.0, step };
    Simulation simulation(setup);
    run(simulation, check_end);
    ASSERT_TRUE(simulation.error_watch().finding()) << method;
    EXPECT_NEAR(simulation.error_watch().finding()->time, check_end, 1e-9);
    EXPECT_NEAR(simulation.error_watch().finding()->step, step, 1e-9);
    const double error = true_error(setup);
    EXPECT_GT(error, 1e-7) << method;
    EXPECT_NEAR(simulation.error_watch().finding()->error, error, 0.5 * error) << method;
  }
}

TEST(ErrorWatch, ChangesNoBitWhileStepsAreExactEnough)
{
  SimulationSetup setup = shaken(step);
  Simulation unwatched(setup);
  setup.error_bounds = { 3.0 * true_error(setup), 0.0, 1.0 };
  Simulation watched(setup);
  const double after_two_checks = check_end + 2.0 * ErrorWatch::least_between + ErrorWatch::horizon;
  run(watched, after_two_checks);
  run(unwatched, after_two_checks);
  EXPECT_GT(watched.error_watch().finding()->time, check_end);
  EXPECT_FALSE(watched.error_watch().corrected_step());
  EXPECT_TRUE(watched.state().positions == unwatched.state().positions);
}

TEST(ErrorWatch, ShortensStepsThatErrTooMuch)
{
  SimulationSetup setup = shaken(step);
  const double tolerance = 0.3 * true_error(setup);
  setup.error_bounds = { tolerance, 0.01, 1.0 };
  Simulation simulation(setup);
  run(simulation, check_end);
  EXPECT_GT(simulation.error_watch().finding()->error, tolerance);
  ASSERT_TRUE(simulation.error_watch().corrected_step());
  EXPECT_LT(simulation.time_step(), 0.5 * step);
  run(simulation, check_end + 2.0 * ErrorWatch::horizon + tick);
  EXPECT_LT(simulation.error_watch().finding()->error, tolerance);
}

TEST(ErrorWatch, ShortensStepsNoFurtherThanThereIsTimeFor)
{
  SimulationSetup setup = shaken(step);
  setup.error_bounds = { 0.1 * true_error(setup), 0.8, 1.0 };
  Simulation simulation(setup);
  run(simulation, check_end + 3.0 * ErrorWatch::horizon);
  EXPECT_NEAR(simulation.time_step(), 0.8 * step, 1e-9);
}

TEST(ErrorWatch, LengthensStepsThatAreFarBelowTwice)
{
  SimulationSetup setup = shaken(step);
  const double tolerance = 30.0 * true_error(setup);
  setup.error_bounds = { tolerance, 0.0, 1.0 };
  Simulation simulation(setup);
  run(simulation, check_end + tick);
  EXPECT_FALSE(simulation.error_watch().corrected_step());
  run(simulation, check_end + 2.0 * ErrorWatch::least_between + ErrorWatch::horizon + tick);
  ASSERT_TRUE(simulation.error_watch().corrected_step());
  EXPECT_NEAR(simulation.time_step(), 2.0 * step, 1e-9);
}

/// A whip that turns over: there is no step that follows it.
TEST(ErrorWatch, ComesBackToTheStepBeforeWhereTheMotionPartsFromItself)
{
  SimulationSetup setup = setup_of(
      "{cloth: {rows: 1, cols: 20, width: 0.3}, springs: {structural: {stiffness: 1000, damping: 0}, flex: "
      "{stiffness: 0}}, gravity: [0, 0, -200], air: {viscous_damping: 0, wind_coupling: 0}, strain_limit: "
      "{max_strain: 0}, pins: [{name: end, nodes: [[0, 0]]}]}",
      "velocity_verlet", tick / 128.0);
  setup.error_bounds = { 1e-5, 0.0, 1.0 };
  Simulation simulation(setup);
  run(simulation, check_end + tick);
  const double error = simulation.error_watch().finding()->error;
  EXPECT_GT(error, 1e-5);
  EXPECT_LT(simulation.time_step(), 0.5 * setup.time_step);
  run(simulation, check_end + ErrorWatch::horizon + 2.0 * tick);
  EXPECT_EQ(simulation.time_step(), setup.time_step);
  run(simulation, check_end + 3.0 * ErrorWatch::least_between);
  EXPECT_EQ(simulation.time_step(), setup.time_step);
}

TEST(ErrorWatch, EndsACheckWithoutAResultWhereTheStateIsChanged)
{
  SimulationSetup setup = shaken(step);
  setup.error_bounds = { 1.0, 1.0, step };
  Simulation simulation(setup);
  run(simulation, check_begin + 0.5);
  simulation.hold("third", { 35 });
  run(simulation, check_end + 0.25);
  EXPECT_FALSE(simulation.error_watch().finding());
  run(simulation, check_end + 1.0);
  EXPECT_TRUE(simulation.error_watch().finding());
}

TEST(ErrorWatch, OfNoToleranceChecksNothing)
{
  Simulation simulation(shaken(step));
  run(simulation, check_end + 1.0);
  EXPECT_FALSE(simulation.error_watch().finding());
}

}  // namespace
}  // namespace cloth
