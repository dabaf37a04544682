#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "cloth_sim/constraints/strain_limit.h"
#include "cloth_sim/forces/springs.h"
#include "cloth_sim/methods/method.h"
#include "cloth_sim/simulation/energy.h"
#include "cloth_sim/simulation/simulation.h"
#include "support.h"

namespace cloth
{
namespace
{

constexpr double limit = 0.05;

/// A square sheet that starts level, held at two corners: it swings down and back.
Simulation swinging_sheet(int nodes_a_side, double time_step, LimitSolver solver, int sweeps)
{
  SheetProperties sheet;
  sheet.rows = nodes_a_side;
  sheet.cols = nodes_a_side;
  SimulationSetup setup;
  setup.model = make_sheet(sheet);
  setup.gravity = { 0.0, 0.0, -9.81 };
  setup.air.wind_coupling = 0.0;
  setup.start.positions = setup.model.rest_positions;
  setup.start.positions.col(1).swap(setup.start.positions.col(2));
  setup.start.velocities = Vectors::Zero(setup.model.nodes(), 3);
  setup.pins = { still_pin("left", { 0 }, setup.start.positions),
                 still_pin("right", { nodes_a_side - 1 }, setup.start.positions) };
  setup.strain_limit = { limit, sweeps, solver };
  setup.method = find_method("xpbd");
  setup.method_settings.iterations = 1;
  setup.time_step = time_step;
  return Simulation(std::move(setup));
}

double passes_a_step(int nodes_a_side, double time_step, LimitSolver solver)
{
  Simulation simulation = swinging_sheet(nodes_a_side, time_step, solver, 10000);
  EXPECT_TRUE(simulation.advance_to(0.5));
  return static_cast<double>(simulation.counters().limit_sweeps) / static_cast<double>(simulation.counters().steps);
}

TEST(SpringTensions, NeedFewPassesThatHardlyGrowWithTheGrid)
{
  const double coarse = passes_a_step(16, 8e-4, LimitSolver::tensions);
  const double fine = passes_a_step(48, 8e-4 / 3.0, LimitSolver::tensions);
  EXPECT_GT(coarse, 0.0);
  EXPECT_LT(coarse, 3.0);
  EXPECT_LT(fine, 3.0);
  EXPECT_GT(passes_a_step(48, 8e-4 / 3.0, LimitSolver::plain_sweeps), 5.0 * fine);
}

/// Passes that a chain which is stretched all along takes at its first step, when no tensions are known.
int passes_from_nothing(int nodes)
{
  const ClothModel model = make_sheet(small_sheet(nodes, 1));
  ClothState state{ 1.2 * model.rest_positions, Vectors::Zero(nodes, 3), 0.0 };
  StrainLimit strain_limit(model, { limit, 100000, LimitSolver::tensions });
  const StrainLimit::Report report = strain_limit.apply(model, Pins(nodes), 1.0, state);
  EXPECT_TRUE(report.reached);
  EXPECT_LE(max_strain(model, state.positions), limit * (1.0 + StrainLimit::tolerance) + 1e-12);
  return report.sweeps;
}

/// Passes alone, without momentum, take four times as many for a chain twice as long.
TEST(SpringTensions, FromNothingTakePassesInProportionToTheLengthOfAChain)
{
  const int passes = passes_from_nothing(17);
  EXPECT_GT(passes, 2);
  EXPECT_LT(passes_from_nothing(33), 2.7 * passes);
  EXPECT_LT(passes_from_nothing(65), 2.7 * 2.7 * passes);
}

/// Its tethers say in one pass what springs, of which each knows its neighbours alone, say in a hundred.
TEST(SpringTensions, ShortenAStretchedChainThatIsHeldAtOnceAndPullOnItsPin)
{
  for (const int nodes : { 9, 65 })
  {
    const ClothModel model = make_sheet(small_sheet(nodes, 1));
    ClothState state{ 1.2 * model.rest_positions, Vectors::Zero(nodes, 3), 0.0 };
    const Vectors before = state.positions;
    Pins pins(nodes);
    pins.hold(still_pin("end", { 0 }, before));
    Vectors impulses = Vectors::Zero(nodes, 3);
    StrainLimit strain_limit(model, { limit, 100, LimitSolver::tensions });
    const StrainLimit::Report report = strain_limit.apply(model, pins, 0.1, state, &impulses);
    EXPECT_TRUE(report.reached) << nodes;
    EXPECT_LE(report.sweeps, 2) << nodes;
    const double held = 1.0 + strain_limit.held_strain();
    const Vectors expected =
        before.row(0).replicate(nodes, 1) + held * (model.rest_positions.rowwise() - model.rest_positions.row(0));
    EXPECT_LT((state.positions - expected).cwiseAbs().maxCoeff(), 1e-12) << nodes;
    const Eigen::RowVector3d gained = model.masses.transpose() * state.velocities;
    EXPECT_LT((impulses.row(0) + gained).norm(), 1e-12 * gained.norm()) << nodes;
  }
}

TEST(SpringTensions, KeepTheLimitAtEveryStepOfASwing)
{
  Simulation simulation = swinging_sheet(24, 5e-4, LimitSolver::tensions, 10000);
  double worst = 0.0;
  for (int step = 1; step <= 2000; ++step)
  {
    ASSERT_TRUE(simulation.advance_to(5e-4 * step));
    worst = std::max(worst, max_strain(simulation.model(), simulation.state().positions));
  }
  EXPECT_LE(worst, limit * (1.0 + StrainLimit::tolerance) + 1e-12);
  EXPECT_GT(worst, limit * (1.0 - StrainLimit::tolerance));
}

/// Tensions that are carried over as they were, without a look at whether they still help, tear this sheet to pieces.
TEST(SpringTensions, StayStableWhereTheyAreNotGivenThePassesThatTheyNeed)
{
  Simulation simulation = swinging_sheet(48, 1e-3, LimitSolver::tensions, 1);
  Simulation enough = swinging_sheet(48, 1e-3, LimitSolver::tensions, 10000);
  ASSERT_TRUE(simulation.advance_to(1.0));
  ASSERT_TRUE(enough.advance_to(1.0));
  EXPECT_LT(max_strain(simulation.model(), simulation.state().positions), 1.0);
  const double kinetic = energies_of(simulation.dynamics(), simulation.state()).kinetic;
  EXPECT_LT(kinetic, 2.0 * energies_of(enough.dynamics(), enough.state()).kinetic + 0.1);
}

TEST(SpringTensions, MoveASheetLessThanPlainSweepsDo)
{
  const ClothModel model = make_sheet(small_sheet(12, 17));
  const auto way = [&](LimitSolver solver) {
    Noise noise;
    ClothState state{ 1.2 * model.rest_positions + 0.01 * noise.vectors(model.nodes()), Vectors::Zero(model.nodes(), 3),
                      0.0 };
    const Vectors before = state.positions;
    StrainLimit(model, { limit, 10000, solver }).apply(model, Pins(model.nodes()), 1.0, state);
    return model.masses.dot((state.positions - before).rowwise().squaredNorm());
  };
  EXPECT_LT(way(LimitSolver::tensions), way(LimitSolver::plain_sweeps));
}

/// The part of its angular momentum that a sheet which spins for so many steps loses to the strain limit.
double spin_loss(int steps, LimitSolver solver)
{
  const ClothModel model = make_sheet(small_sheet(9, 13));
  AirProperties none;
  none.viscous_damping = none.wind_coupling = 0.0;
  const Dynamics dynamics(model, Eigen::Vector3d::Zero(), none);
  StrainLimit strain_limit(model, { limit, 10000, solver });
  ClothState state{ model.rest_positions, Vectors::Zero(model.nodes(), 3), 0.0 };
  const Eigen::RowVector3d middle = model.masses.transpose() * state.positions / model.masses.sum();
  const Eigen::RowVector3d spin(0.0, 60.0, 0.0);
  for (int i = 0; i < model.nodes(); ++i)
  {
    state.velocities.row(i) = spin.cross(state.positions.row(i) - middle);
  }
  const Eigen::Vector3d before = angular_momentum_of(model, state);
  const auto method = make(*find_method("velocity_verlet"));
  for (int step = 0; step < steps; ++step)
  {
    method->step(dynamics, 0.4 / steps, state);
    strain_limit.apply(model, dynamics.pins(), 0.4 / steps, state);
    method->restart();
  }
  EXPECT_LT(momentum_of(model, state).norm(), 1e-11);
  return 1.0 - angular_momentum_of(model, state).norm() / before.norm();
}

/// A correction of positions and velocities at once is of first order in h, whoever makes it.
TEST(SpringTensions, TakeAngularMomentumFromASpinningSheetInFirstOrderAloneAsPlainSweepsDo)
{
  const double loss = spin_loss(2000, LimitSolver::tensions);
  EXPECT_GT(loss, 0.01);
  EXPECT_NEAR(spin_loss(4000, LimitSolver::tensions) / loss, 0.5, 0.1);
  EXPECT_LT(loss, 2.0 * spin_loss(2000, LimitSolver::plain_sweeps));
}

}  // namespace
}  // namespace cloth
