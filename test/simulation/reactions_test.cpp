// What the cloth does to those who hold it.

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "cloth_sim/simulation/energy.h"
#include "support.h"

namespace cloth
{
namespace
{

const Eigen::Vector3d gravity(0.5, -1.0, -9.81);

class Reactions : public testing::TestWithParam<MethodRow>
{
protected:
  /// A shaken sheet in a vacuum, held by a corner that stays, by two nodes that swing, and by two that are turned.
  static Simulation moving_sheet(double max_strain)
  {
    SimulationSetup setup = springs_alone(small_sheet(), GetParam().name, 0.0);
    setup.method_settings = one_step_a_call(GetParam());
    setup.gravity = gravity;
    setup.strain_limit = { max_strain, 30 };
    const double limit = Simulation(setup).stability_limit();
    setup.time_step = limit > 0.0 ? 0.5 * std::min(limit, 2e-3) : 2e-5;  // without one it grows slowly at least
    Noise noise;
    setup.start.positions += 0.003 * noise.vectors(setup.model.nodes());
    setup.start.velocities = 0.3 * noise.vectors(setup.model.nodes());
    setup.pins = { still_pin("still", { 0 }, setup.start.positions),
                   still_pin("swinging", { 4, 5 }, setup.start.positions),
                   still_pin("turning", { 24, 25 }, setup.start.positions) };
    setup.pins[1].oscillation = { { 0.02, 0.05, 0.0 }, 2.0, 0.3 };
    Simulation simulation(setup);
    const Eigen::Vector3d pivot(-0.3, 0.0, 0.0);
    const Eigen::Translation3d to_pivot(pivot);
    const Eigen::Isometry3d turn(Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitX()));
    simulation.carry("turning", to_pivot * turn * to_pivot.inverse(), pivot, 0.4);
    return simulation;
  }

  /// Expects the balance of momentum from now on to `time`.
  static void expect_balance(double time, Simulation& simulation)
  {
    const double begin = simulation.state().time;
    const auto steps_before = simulation.counters().steps;
    const ClothModel& model = simulation.model();
    const Eigen::Vector3d before = momentum_of(model, simulation.state());
    simulation.measure_reactions(true);
    ASSERT_TRUE(simulation.advance_to(time)) << simulation.divergence_report();
    Eigen::Vector3d on_holders = Eigen::Vector3d::Zero();
    for (const Pin& pin : simulation.pins().all())
    {
      on_holders += simulation.reaction_on(pin).force;
    }
    EXPECT_GT(on_holders.norm(), 0.1 * model.masses.sum() * gravity.norm());
    const Eigen::Vector3d change = momentum_of(model, simulation.state()) - before;
    const Eigen::Vector3d expected = (time - begin) * (model.masses.sum() * gravity - on_holders);
    // What a step leaves: rounding, of positions too over a short step; or the rest of the implicit methods' equations.
    const double rounding = 1e-12 + std::numeric_limits<double>::epsilon() * model.width / simulation.time_step();
    const double a_step = GetParam().linear_solves > 0 ? 1e-9 : rounding;
    const double fastest = std::sqrt(simulation.state().velocities.rowwise().squaredNorm().maxCoeff());
    const double steps = static_cast<double>(simulation.counters().steps - steps_before);
    EXPECT_LT((change - expected).norm(), a_step * steps * model.masses.sum() * (1.0 + fastest));
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, Reactions, testing::ValuesIn(methods()), name_of_method);

TEST_P(Reactions, KeepTheBalanceOfMomentum)
{
  Simulation simulation = moving_sheet(0.0);
  ASSERT_TRUE(simulation.advance_to(0.1));
  for (int k = 1; k <= 5; ++k)
  {
    expect_balance(0.1 + k / 30.0, simulation);
  }
  expect_balance(0.6, simulation);
}

TEST_P(Reactions, KeepTheBalanceOfMomentumWithTheStrainLimitActing)
{
  Simulation simulation = moving_sheet(0.005);
  ASSERT_TRUE(simulation.advance_to(0.1));
  for (int k = 1; k <= 5; ++k)
  {
    expect_balance(0.1 + k / 30.0, simulation);
  }
  EXPECT_GT(simulation.counters().limit_sweeps, simulation.counters().steps / 10);
}

TEST_P(Reactions, LeaveTheMotionAsItIs)
{
  Simulation measured = moving_sheet(0.01);
  Simulation other = moving_sheet(0.01);
  for (int k = 1; k <= 4; ++k)
  {
    measured.measure_reactions(k % 2 == 0);
    measured.advance_to(0.05 * k);
    other.advance_to(0.05 * k);
  }
  EXPECT_EQ(measured.state().positions, other.state().positions);
  EXPECT_EQ(measured.state().velocities, other.state().velocities);
  EXPECT_EQ(measured.counters().force_evaluations, other.counters().force_evaluations);
}

TEST_P(Reactions, AtRestCarryTheWeightAndItsMomentPinByPin)
{
  SceneParams scene = shipped_scene("hanging_sheet");
  scene.sheet.rows = scene.sheet.cols = 8;
  scene.sheet.structural.damping = scene.sheet.shear.damping = 0.1;  // explicit Euler lives on it
  scene.start.shape = "settled";
  scene.strain_limit.max_strain = 0.0;
  scene.pins = { { "corner", "", { { { 0, 0 }, { 0, 1 }, { 1, 0 } } }, {} }, { "edge", "", { { { 2, 7 } } }, {} } };
  scene.solver.method = GetParam().name;
  scene.solver.time_step = GetParam().linear_solves > 0 ? 1e-3 : 0.0;
  Simulation simulation = build_simulation(make_plan(scene));
  simulation.measure_reactions(true);
  ASSERT_TRUE(simulation.advance_to(0.05)) << simulation.divergence_report();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const Pin& pin : simulation.pins().all())
  {
    const Wrench wrench = simulation.reaction_on(pin);
    force += wrench.force;
    moment += wrench.torque + pin.middle(0.05).cross(wrench.force);
  }
  const ClothModel& model = simulation.model();
  const Eigen::Vector3d weight = model.masses.sum() * scene.gravity;
  const Eigen::Vector3d centre = simulation.state().positions.transpose() * model.masses / model.masses.sum();
  // At rest to what settling leaves; xpbd in its few substeps is softer than the springs, and sinks a little.
  const double tolerance = std::string(GetParam().name) == "xpbd" ? 0.01 : 1e-4;
  EXPECT_LT((force - weight).norm(), tolerance * weight.norm()) << force.transpose();
  EXPECT_LT((moment - centre.cross(weight)).norm(), tolerance * weight.norm()) << moment.transpose();
}

TEST_P(Reactions, OfAHeldNodeWithoutSpringsAreItsWeightAndInertia)
{
  SheetProperties sheet = small_sheet();
  sheet.structural.stiffness = sheet.shear.stiffness = sheet.flex.stiffness = 0.0;
  SimulationSetup setup = springs_alone(sheet, GetParam().name, 1e-3);
  setup.method_settings = one_step_a_call(GetParam());
  setup.gravity = gravity;
  setup.pins = { still_pin("hand", { 7 }, setup.start.positions) };
  setup.pins[0].oscillation = { { 0.0, 0.1, 0.0 }, 1.0, 0.0 };
  Simulation simulation(setup);
  simulation.advance_to(0.1);
  const Eigen::Vector3d before = simulation.state().velocities.row(7);
  simulation.measure_reactions(true);
  simulation.advance_to(0.2);
  const Eigen::Vector3d acceleration = (simulation.state().velocities.row(7).transpose() - before) / 0.1;
  const Eigen::Vector3d expected = setup.model.masses[7] * (gravity - acceleration);
  EXPECT_LT((simulation.reaction_on(simulation.pins().all()[0]).force - expected).norm(), 1e-12);
}

TEST(Reaction, IsNoneWhereNothingIsMeasured)
{
  SimulationSetup setup = springs_alone(small_sheet(), "velocity_verlet", 1e-3);
  setup.gravity = gravity;
  setup.pins = { still_pin("hand", { 0 }, setup.start.positions) };
  Simulation simulation(setup);
  simulation.advance_to(0.1);
  EXPECT_TRUE(simulation.reaction_on(simulation.pins().all()[0]).force.isZero(0.0));
  simulation.measure_reactions(true);
  EXPECT_TRUE(simulation.reaction_on(simulation.pins().all()[0]).force.isZero(0.0));
  simulation.advance_to(0.2);
  EXPECT_LT(simulation.reaction_on(simulation.pins().all()[0]).force.z(), 0.0);
}

}  // namespace
}  // namespace cloth
