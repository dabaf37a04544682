#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "cloth_sim/constraints/strain_limit.h"
#include "cloth_sim/forces/springs.h"
#include "cloth_sim/methods/method.h"
#include "cloth_sim/model/wide_vectors.h"
#include "cloth_sim/simulation/energy.h"
#include "cloth_sim/simulation/simulation.h"
#include "support.h"

namespace cloth
{
namespace
{

constexpr double frame = 1.0 / 60.0;

/// A sheet that starts level, held at two corners, in substeps of steps of 1/60 s.
SimulationSetup level_sheet(int rows, int cols, int substeps, Precision precision)
{
  SheetProperties sheet;
  sheet.rows = rows;
  sheet.cols = cols;
  SimulationSetup setup;
  setup.model = make_sheet(sheet);
  setup.gravity = { 0.0, 0.0, -9.81 };
  setup.air.wind_coupling = 0.0;
  setup.start.positions = setup.model.rest_positions;
  setup.start.positions.col(1).swap(setup.start.positions.col(2));
  setup.start.velocities = Vectors::Zero(setup.model.nodes(), 3);
  setup.pins = { still_pin("left", { 0 }, setup.start.positions),
                 still_pin("right", { cols - 1 }, setup.start.positions) };
  setup.strain_limit.max_strain = 0.0;
  setup.method = find_method("xpbd");
  setup.method_settings.iterations = substeps;
  setup.method_settings.precision = precision;
  setup.time_step = frame;
  return setup;
}

Vectors positions_at(double time, SimulationSetup setup)
{
  Simulation simulation(std::move(setup));
  EXPECT_TRUE(simulation.advance_to(time));
  return simulation.state().positions;
}

double farthest(const Vectors& a, const Vectors& b)
{
  return std::sqrt((a - b).rowwise().squaredNorm().maxCoeff());
}

/// One spring has no order in which springs could be corrected: what is left is rounding.
TEST(MixedPrecision, OfOneSpringDiffersByRoundingAlone)
{
  const auto swing = [](Precision precision) {
    SimulationSetup setup = level_sheet(1, 2, 16, precision);
    setup.pins.resize(1);
    return positions_at(0.5, std::move(setup));
  };
  const double difference = farthest(swing(Precision::in_double), swing(Precision::mixed));
  EXPECT_GT(difference, 1e-12);
  EXPECT_LT(difference, 2e-5);
}

/// The order of the springs is another one, which matters the less the shorter the substeps are.
TEST(MixedPrecision, ConvergesToWhatDoublesConvergeTo)
{
  for (const double wind_coupling : { 0.0, 1.0 })
  {
    const auto swing = [&](int substeps, Precision precision) {
      SimulationSetup setup = level_sheet(9, 20, substeps, precision);
      setup.air.wind_coupling = wind_coupling;
      return positions_at(6.0 * frame, std::move(setup));
    };
    const Vectors fine = swing(1600, Precision::in_double);
    const double error_of_doubles = farthest(swing(100, Precision::in_double), fine);
    EXPECT_GT(error_of_doubles, 1e-5);
    EXPECT_LT(farthest(swing(100, Precision::mixed), fine), 2.0 * error_of_doubles);
  }
}

/// The largest strain at the end of any step of a swing.
double worst_strain_of(Simulation& simulation, int steps)
{
  double worst = 0.0;
  for (int step = 1; step <= steps; ++step)
  {
    EXPECT_TRUE(simulation.advance_to(step * frame));
    worst = std::max(worst, max_strain(simulation.model(), simulation.state().positions));
  }
  return worst;
}

constexpr double kept = 0.05 * (1.0 + StrainLimit::tolerance) + 1e-12;

TEST(MixedPrecision, KeepsTheStrainLimitAtEveryStep)
{
  for (const int nodes_a_side : { 6, 17, 24, 40 })
  {
    SimulationSetup setup = level_sheet(nodes_a_side, nodes_a_side, 8 + nodes_a_side / 8, Precision::mixed);
    setup.strain_limit = { 0.05, 5000, LimitSolver::tensions };
    Simulation simulation(std::move(setup));
    const double worst = worst_strain_of(simulation, 120);
    EXPECT_LE(worst, kept) << nodes_a_side;
    EXPECT_GT(worst, 0.04) << nodes_a_side;
  }
}

TEST(MixedPrecision, KeepsALimitByPlainSweepsAsWell)
{
  SimulationSetup setup = level_sheet(12, 12, 8, Precision::mixed);
  setup.strain_limit = { 0.05, 5000, LimitSolver::plain_sweeps };
  Simulation simulation(std::move(setup));
  EXPECT_LE(worst_strain_of(simulation, 60), kept);
  EXPECT_GT(simulation.counters().limit_sweeps, 60U);
}

/// Two passes a substep are the least where springs are taut; what is above them are those at the ends of steps.
TEST(MixedPrecision, TakesLittleMoreThanTwoPassesOfTheLimitASubstepWhateverTheGrid)
{
  for (const int nodes_a_side : { 24, 48 })
  {
    const int substeps = nodes_a_side / 4;
    SimulationSetup setup = level_sheet(nodes_a_side, nodes_a_side, substeps, Precision::mixed);
    setup.strain_limit = { 0.05, 300, LimitSolver::tensions };
    Simulation simulation(std::move(setup));
    ASSERT_TRUE(simulation.advance_to(180 * frame));
    const double passes = static_cast<double>(simulation.counters().limit_sweeps) / (180.0 * substeps);
    EXPECT_GT(passes, 1.8) << nodes_a_side;
    EXPECT_LT(passes, 3.5) << nodes_a_side;
  }
}

/// A margin that is there from the first would pull together what is stretched nearly as far as it may be.
TEST(MixedPrecision, LeavesAloneWhatStartsBelowItsLimit)
{
  const auto contracted = [](double max_strain) {
    SimulationSetup setup = level_sheet(16, 16, 16, Precision::mixed);
    setup.gravity.setZero();
    setup.pins.clear();
    setup.start.positions *= 1.045;
    setup.strain_limit = { max_strain, 300, LimitSolver::tensions };
    return positions_at(0.1 * frame, std::move(setup));
  };
  EXPECT_EQ(farthest(contracted(0.05), contracted(0.0)), 0.0);
}

/// What is left undone in some substeps is a speed in the next, over its length: a sheet that hangs stretched nearly to
/// its limit was thrown about until it diverged.
TEST(MixedPrecision, StaysCalmInShortSubstepsUnderALimit)
{
  for (const int substeps : { 4, 8 })
  {
    SimulationSetup setup = level_sheet(6, 6, substeps, Precision::mixed);
    setup.start.positions = 1.05 * setup.model.rest_positions;
    setup.pins = { still_pin("left", { 0 }, setup.start.positions), still_pin("right", { 5 }, setup.start.positions) };
    setup.air.viscous_damping = 0.3;
    setup.strain_limit = { 0.052, 30, LimitSolver::tensions };
    setup.time_step = 5e-4;
    Simulation simulation(std::move(setup));
    ASSERT_TRUE(simulation.advance_to(1.0)) << simulation.divergence_report();
    EXPECT_LT(energies_of(simulation.dynamics(), simulation.state()).kinetic, 0.1) << substeps;
  }
}

/// The margin below the limit is for commotion: a sheet that has come to rest hangs as long as its limit lets it.
TEST(MixedPrecision, LetsASheetAtRestReachItsLimit)
{
  SimulationSetup setup = level_sheet(16, 16, 8, Precision::mixed);
  setup.strain_limit = { 0.05, 300, LimitSolver::tensions };
  Simulation simulation(std::move(setup));
  ASSERT_TRUE(simulation.advance_to(15.0));
  const double strain = max_strain(simulation.model(), simulation.state().positions);
  EXPECT_LE(strain, kept);
  EXPECT_GT(strain, 0.0485);
}

/// Springs that were tightened at once, or by a single pass a substep, shook it for ever.
TEST(MixedPrecision, BringsASheetThatHangsInItsLimitToRest)
{
  SimulationSetup setup = level_sheet(48, 48, 12, Precision::mixed);
  setup.strain_limit = { 0.05, 300, LimitSolver::tensions };
  Simulation simulation(std::move(setup));
  ASSERT_TRUE(simulation.advance_to(15.0));
  for (int step = 901; step <= 1020; ++step)
  {
    ASSERT_TRUE(simulation.advance_to(step * frame));
    const Eigen::VectorXd squares = simulation.state().velocities.rowwise().squaredNorm();
    EXPECT_LT(0.5 * simulation.model().masses.dot(squares), 1e-6);
  }
}

TEST(MixedPrecision, KeepsTheMomentumOfWhatIsFree)
{
  SimulationSetup setup = level_sheet(12, 20, 8, Precision::mixed);
  setup.gravity.setZero();
  setup.air.viscous_damping = 0.0;
  setup.pins.clear();
  setup.strain_limit = { 0.02, 1000, LimitSolver::tensions };
  for (int node = 0; node < setup.model.nodes(); ++node)
  {
    const double x = setup.start.positions(node, 0);
    setup.start.velocities.row(node) << 0.3 + 3.0 * x, std::sin(0.7 * node), 4.0 * x;
  }
  Simulation simulation(std::move(setup));
  const auto momentum = [&]() -> Eigen::RowVector3d {
    return simulation.model().masses.transpose() * simulation.state().velocities;
  };
  const Eigen::RowVector3d before = momentum();
  ASSERT_TRUE(simulation.advance_to(0.5));
  EXPECT_GT(simulation.counters().limit_sweeps, 0U);
  EXPECT_LT((momentum() - before).norm(), 5e-5 * before.norm());
}

TEST(MixedPrecision, TellsWhatTheSheetDoesToItsPins)
{
  SimulationSetup setup = level_sheet(10, 20, 8, Precision::mixed);
  setup.air.viscous_damping = 0.0;
  setup.strain_limit = { 0.05, 1000, LimitSolver::tensions };
  Simulation simulation(std::move(setup));
  simulation.measure_reactions(true);
  const auto momentum = [&]() -> Eigen::Vector3d {
    return (simulation.model().masses.transpose() * simulation.state().velocities).transpose();
  };
  ASSERT_TRUE(simulation.advance_to(0.5));
  Eigen::Vector3d on_pins = Eigen::Vector3d::Zero();
  for (const Pin& pin : simulation.pins().all())
  {
    on_pins += simulation.reaction_on(pin).force;
  }
  const Eigen::Vector3d weight(0.0, 0.0, -9.81 * simulation.model().masses.sum());
  EXPECT_LT((0.5 * (weight - on_pins) - momentum()).norm(), 1e-4 * 0.5 * weight.norm());
}

/// The wind on held nodes goes by the normals of where their neighbours are in each substep of a long step.
TEST(MixedPrecision, TellsWhatTheWindDoesToPins)
{
  const auto force_on_edge = [](Precision precision) -> Eigen::Vector3d {
    constexpr int rows = 20;
    constexpr int cols = 4;
    SimulationSetup setup = level_sheet(rows, cols, 600, precision);
    std::vector<int> edge;
    for (int row = 0; row < rows; ++row)
    {
      edge.push_back(row * cols);
    }
    setup.pins = { still_pin("edge", edge, setup.start.positions) };
    setup.air.wind_coupling = 1.0;
    setup.air.wind = { 1.0, 2.0, 8.0 };
    setup.time_step = 12.0 * frame;
    Simulation simulation(std::move(setup));
    simulation.measure_reactions(true);
    EXPECT_TRUE(simulation.advance_to(12.0 * frame));
    return simulation.reaction_on(*simulation.pins().find("edge")).force;
  };
  const Eigen::Vector3d expected = force_on_edge(Precision::in_double);
  EXPECT_GT(expected.norm(), 0.1);
  EXPECT_LT((force_on_edge(Precision::mixed) - expected).norm(), 0.02 * expected.norm());
}

/// Single precision is rounded in another order in vectors of another width.
TEST(MixedPrecision, IsTheSameInAnyVectorsButForRounding)
{
  const VectorWidth before = vector_width();
  const auto swing = [] { return positions_at(3.0 * frame, level_sheet(12, 20, 32, Precision::mixed)); };
  const Vectors expected = swing();
  for (const VectorWidth width : vector_widths())
  {
    use_vector_width(width);
    EXPECT_LT(farthest(swing(), expected), 1e-5);
  }
  use_vector_width(before);
}

TEST(MixedPrecision, HoldsCarriedPinsWhereTheyBelong)
{
  SimulationSetup setup = level_sheet(8, 20, 8, Precision::mixed);
  setup.strain_limit = { 0.05, 100, LimitSolver::tensions };
  Simulation simulation(std::move(setup));
  const Eigen::Vector3d target = simulation.pins().find("left")->held_middle() + Eigen::Vector3d(0.0, 0.0, 0.5);
  ASSERT_TRUE(simulation.carry("left", target, 10.5 * frame));
  ASSERT_TRUE(simulation.advance_to(20.0 * frame));
  EXPECT_LT((simulation.state().positions.row(0) - target.transpose()).norm(), 1e-12);
  EXPECT_EQ(simulation.state().velocities.row(0).norm(), 0.0);
}

}  // namespace
}  // namespace cloth
