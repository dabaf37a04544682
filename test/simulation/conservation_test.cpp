// What the equations conserve, for every method of the table.

#include <cmath>

#include <gtest/gtest.h>

#include "cloth_sim/methods/spectrum.h"
#include "cloth_sim/simulation/energy.h"
#include "support.h"

namespace cloth
{
namespace
{

class Conservation : public testing::TestWithParam<MethodRow>
{
protected:
  /// A free sheet that shakes, drifts and turns.
  SimulationSetup shaken_sheet() const
  {
    SimulationSetup setup = springs_alone(small_sheet(), GetParam().name, 0.0);
    setup.method_settings = one_step_a_call(GetParam());
    setup.time_step = step_for(setup);
    Noise noise;
    setup.start.positions += 0.003 * noise.vectors(setup.model.nodes());
    setup.start.velocities = 0.3 * noise.vectors(setup.model.nodes());
    setup.start.velocities.rowwise() += Eigen::RowVector3d(0.2, -0.1, 0.3);
    setup.start.velocities.col(1) += 2.0 * setup.start.positions.col(0);
    return setup;
  }

  /// Nine tenths of the stability limit where there is one, whatever follows the sheet's swings elsewhere, and where no
  /// step is stable one at which the energy grows by a twentieth in 1e5 steps.
  static double step_for(const SimulationSetup& setup)
  {
    const Simulation simulation(setup);
    const double limit = simulation.stability_limit();
    if (limit > 0.0)
    {
      return 0.9 * std::min(limit, 2e-3);
    }
    const auto [factor, power] = GetParam().energy_drift;
    const double stiffest = spectrum_of(simulation.dynamics(), setup.start.positions).frequency;
    return std::pow(0.05 / (1e5 * factor), 1.0 / power) / stiffest;
  }

  static void undamp(SimulationSetup& setup)
  {
    for (SpringBatch& batch : setup.model.springs)
    {
      batch.damping = 0.0;
    }
    setup.time_step = step_for(setup);
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, Conservation, testing::ValuesIn(methods()), name_of_method);

/// What the size of a momentum is measured by.
double scale_of(const ClothModel& model, const ClothState& state)
{
  return model.masses.dot(state.velocities.rowwise().norm());
}

TEST_P(Conservation, MomentumOfAFreeSheetStaysOverAHundredThousandSteps)
{
  const SimulationSetup setup = shaken_sheet();
  Simulation simulation(setup);
  const Eigen::Vector3d before = momentum_of(simulation.model(), simulation.state());
  const double scale = scale_of(simulation.model(), simulation.state());
  simulation.advance_to(1e5 * setup.time_step);
  EXPECT_GE(simulation.counters().steps, 99000u);
  EXPECT_LT((momentum_of(simulation.model(), simulation.state()) - before).norm(), 1e-12 * scale);
}

TEST_P(Conservation, MomentumOfAFreeSheetStaysWithTheStrainLimitActing)
{
  SimulationSetup setup = shaken_sheet();
  setup.strain_limit = { 0.005, 30 };
  Simulation simulation(setup);
  const Eigen::Vector3d before = momentum_of(simulation.model(), simulation.state());
  const double scale = scale_of(simulation.model(), simulation.state());
  simulation.advance_to(1000.0 * setup.time_step);
  EXPECT_GT(simulation.counters().limit_sweeps, simulation.counters().steps / 10);
  EXPECT_LT((momentum_of(simulation.model(), simulation.state()) - before).norm(), 1e-12 * scale);
}

TEST_P(Conservation, AngularMomentumOfAFreeUndampedSheetStaysWhereTheTableSaysSo)
{
  SimulationSetup setup = shaken_sheet();
  undamp(setup);
  Simulation simulation(setup);
  const Eigen::Vector3d before = angular_momentum_of(simulation.model(), simulation.state());
  simulation.advance_to(std::min(5.0, 2e5 * setup.time_step));
  const double drift = (angular_momentum_of(simulation.model(), simulation.state()) - before).norm() / before.norm();
  if (GetParam().conserves_angular_momentum)
  {
    // A method that solves its equations conserves it as exactly as it solves them.
    EXPECT_LT(drift, GetParam().linear_solves > 0 ? 1e-9 : 1e-11);
  }
  else
  {
    EXPECT_GT(drift, 1e-8);
  }
}

TEST_P(Conservation, CentreOfMassFallsFreely)
{
  SimulationSetup setup = shaken_sheet();
  setup.gravity = { 0.0, 0.0, -9.81 };
  const Eigen::Vector3d middle = setup.start.positions.transpose() * setup.model.masses / setup.model.masses.sum();
  Simulation simulation(setup);
  const Eigen::Vector3d velocity = momentum_of(simulation.model(), simulation.state()) / setup.model.masses.sum();
  const double time = 0.7;
  simulation.advance_to(time);
  const Eigen::Vector3d now = simulation.state().positions.transpose() * setup.model.masses / setup.model.masses.sum();
  const Eigen::Vector3d exact = middle + time * velocity + 0.5 * time * time * setup.gravity;
  // Semi-implicit Euler falls h g t/2 farther: its order is 1. The others' quadrature of a constant is exact.
  const double tolerance = GetParam().order == 1 ? 0.6 * 9.81 * time * simulation.time_step() : 1e-12;
  EXPECT_LT((now - exact).norm(), tolerance);
}

TEST_P(Conservation, EnergyOfAnUndampedSheetIsKeptLostOrGainedAsTheTableSays)
{
  SimulationSetup setup = shaken_sheet();
  undamp(setup);
  setup.time_step *= 0.25;
  Simulation simulation(setup);
  const double before = energies_of(simulation.dynamics(), simulation.state()).total();
  const double end = std::min(10.0, 2e5 * setup.time_step);
  double highest = 0.0;
  double lowest = 1.0;
  double last = 1.0;
  for (int k = 1; k <= 200; ++k)
  {
    simulation.advance_to(end * k / 200);
    last = energies_of(simulation.dynamics(), simulation.state()).total() / before;
    highest = std::max(highest, last);
    lowest = std::min(lowest, last);
  }
  const double factor = GetParam().energy_drift.factor;
  if (factor > 0.0)
  {
    EXPECT_GT(last, 1.0 + 1e-6);
  }
  else if (factor < 0.0)
  {
    EXPECT_LT(last, 1.0 - 1e-4);
    EXPECT_LT(highest, 1.03);
  }
  else
  {
    const double bound = GetParam().order == 1 ? 0.15 : 0.03;
    EXPECT_LT(highest, 1.0 + bound);
    EXPECT_GT(lowest, 1.0 - bound);
  }
}

TEST_P(Conservation, DampingTakesEnergyOutAndNeverPutsItIn)
{
  SimulationSetup setup = shaken_sheet();
  setup.air = { 0.3, 1.0, Eigen::Vector3d::Zero(), {} };
  setup.time_step = 0.1 * step_for(setup);
  Simulation simulation(setup);
  const double end = std::min(2.0, 2e5 * setup.time_step);
  double before = energies_of(simulation.dynamics(), simulation.state()).total();
  for (int k = 1; k <= 40; ++k)
  {
    simulation.advance_to(end * k / 40);
    const double now = energies_of(simulation.dynamics(), simulation.state()).total();
    EXPECT_LT(now, before);
    before = now;
  }
}

TEST(Energies, AreThoseOfTheParts)
{
  SimulationSetup setup = springs_alone(chain(2, 100.0, 0.5), "velocity_verlet", 1e-3);
  setup.gravity = { 0.0, 0.0, -10.0 };
  setup.start.positions.col(2) << 2.0, 0.7;  // stretched by 0.3 m
  setup.start.velocities.col(0) << 1.0, 2.0;
  const Simulation simulation(setup);
  const Energies energies = energies_of(simulation.dynamics(), simulation.state());
  EXPECT_NEAR(energies.kinetic, 0.5 * 0.5 * (1.0 + 4.0), 1e-15);
  EXPECT_NEAR(energies.elastic, 0.5 * 100.0 * 0.09, 1e-13);
  EXPECT_NEAR(energies.gravitational, 0.5 * 10.0 * 2.7, 1e-14);
  EXPECT_NEAR(energies.total(), energies.kinetic + energies.elastic + energies.gravitational, 1e-14);
  EXPECT_TRUE(momentum_of(simulation.model(), simulation.state()).isApprox(Eigen::Vector3d(1.5, 0.0, 0.0)));
  // Sum of z m v_x along y: 0.5 (2 * 1 + 0.7 * 2)
  EXPECT_TRUE(angular_momentum_of(simulation.model(), simulation.state()).isApprox(Eigen::Vector3d(0.0, 1.7, 0.0)));
}

}  // namespace
}  // namespace cloth
