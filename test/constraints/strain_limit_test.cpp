#include "cloth_sim/constraints/strain_limit.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "cloth_sim/forces/springs.h"
#include "cloth_sim/simulation/energy.h"
#include "support.h"

namespace cloth
{
namespace
{

std::string name_of_solver(const testing::TestParamInfo<LimitSolver>& info)
{
  return info.param == LimitSolver::tensions ? "Tensions" : "PlainSweeps";
}

const auto both_solvers = testing::Values(LimitSolver::tensions, LimitSolver::plain_sweeps);

/// Two masses on one spring of 1 m along z.
class OneSpring : public testing::TestWithParam<LimitSolver>
{
protected:
  void stretch_to(double length)
  {
    state_.positions = model_.rest_positions;
    state_.positions(1, 2) = -length;
    state_.velocities = Vectors::Zero(2, 3);
  }

  StrainLimit::Report apply()
  {
    return StrainLimit(model_, { 0.1, 5, GetParam() }).apply(model_, pins_, 0.01, state_);
  }

  double strain() const
  {
    return (state_.positions.row(1) - state_.positions.row(0)).norm() - 1.0;
  }

  /// What is left of the strain: max_strain, or a little less.
  static double target()
  {
    return GetParam() == LimitSolver::tensions ? 0.1 * (1.0 - StrainLimit::least_margin) : 0.1;
  }

  ClothModel model_ = make_sheet(chain(2, 100.0, 0.5));
  Pins pins_{ 2 };
  ClothState state_;
};

INSTANTIATE_TEST_SUITE_P(StrainLimit, OneSpring, both_solvers, name_of_solver);

TEST_P(OneSpring, IsShortenedToTheTargetExactly)
{
  stretch_to(1.7);
  const StrainLimit::Report report = apply();
  EXPECT_TRUE(report.moved);
  EXPECT_TRUE(report.reached);
  EXPECT_NEAR(strain(), target(), 1e-15);
}

TEST_P(OneSpring, EqualMassesShareTheShiftEqually)
{
  stretch_to(1.7);
  apply();
  EXPECT_NEAR(state_.positions(0, 2), -0.5 * (0.7 - target()), 1e-15);
  EXPECT_NEAR(state_.positions(1, 2), -1.7 + 0.5 * (0.7 - target()), 1e-15);
}

TEST_P(OneSpring, UnequalMassesShareItByInverseMass)
{
  model_.masses << 3.0, 1.0;
  stretch_to(1.7);
  apply();
  EXPECT_NEAR(state_.positions(0, 2), -0.25 * (0.7 - target()), 1e-15);
  EXPECT_NEAR(state_.positions(1, 2), -1.7 + 0.75 * (0.7 - target()), 1e-15);
}

TEST_P(OneSpring, APinnedEndStays)
{
  stretch_to(1.7);
  pins_.hold(still_pin("top", { 0 }, state_.positions));
  apply();
  EXPECT_EQ(state_.positions(0, 2), 0.0);
  EXPECT_NEAR(state_.positions(1, 2), -1.0 - target(), 1e-15);
  EXPECT_TRUE(state_.velocities.row(0).isZero(0.0));
}

TEST_P(OneSpring, BetweenTwoPinsIsLeftAlone)
{
  stretch_to(1.7);
  pins_.hold(still_pin("both", { 0, 1 }, state_.positions));
  const StrainLimit::Report report = apply();
  EXPECT_FALSE(report.moved);
  EXPECT_LE(report.sweeps, 1);
  EXPECT_NEAR(strain(), 0.7, 1e-15);
}

TEST_P(OneSpring, VelocityFollowsTheCorrection)
{
  stretch_to(1.7);
  state_.velocities.col(0).setOnes();
  const Vectors before = state_.positions;
  apply();
  Vectors expected = (state_.positions - before) / 0.01;
  expected.col(0).array() += 1.0;
  EXPECT_TRUE(state_.velocities.isApprox(expected, 1e-14));
}

TEST_P(OneSpring, BelowTheLimitAndUnderCompressionNothingHappens)
{
  for (const double length : { 1.0999, 1.0, 0.2 })
  {
    stretch_to(length);
    const ClothState before = state_;
    EXPECT_FALSE(apply().moved);
    EXPECT_EQ(state_.positions, before.positions);
    EXPECT_EQ(state_.velocities, before.velocities);
  }
}

TEST_P(OneSpring, PullsOnAPinWithTheImpulseThatItGivesToTheOtherEnd)
{
  stretch_to(1.7);
  pins_.hold(still_pin("top", { 0 }, state_.positions));
  Vectors impulses = Vectors::Zero(2, 3);
  StrainLimit(model_, { 0.1, 5, GetParam() }).apply(model_, pins_, 0.01, state_, &impulses);
  EXPECT_TRUE(impulses.row(0).isApprox(-model_.masses[1] * state_.velocities.row(1), 1e-14));
}

class StretchedSheet : public testing::TestWithParam<LimitSolver>
{
protected:
  StretchedSheet()
  {
    Noise noise;
    state_.positions = 1.3 * model_.rest_positions + 0.01 * noise.vectors(model_.nodes());
    state_.velocities = noise.vectors(model_.nodes());
  }

  /// The nearest sheet that obeys the limit is harder to find from nothing than any sheet that does.
  static int enough_passes()
  {
    return GetParam() == LimitSolver::tensions ? 10000 : 1000;
  }

  StrainLimit::Report apply(int passes)
  {
    return StrainLimit(model_, { 0.1, passes, GetParam() }).apply(model_, pins_, 0.01, state_);
  }

  const ClothModel model_ = make_sheet(small_sheet());
  Pins pins_{ model_.nodes() };
  ClothState state_;
};

INSTANTIATE_TEST_SUITE_P(StrainLimit, StretchedSheet, both_solvers, name_of_solver);

TEST_P(StretchedSheet, SweepsReachTheLimitEverywhere)
{
  const StrainLimit::Report report = apply(enough_passes());
  EXPECT_TRUE(report.reached);
  EXPECT_LE(max_strain(model_, state_.positions), 0.1 * (1.0 + StrainLimit::tolerance) + 1e-15);
}

TEST_P(StretchedSheet, FewSweepsDoNotAndSaySo)
{
  const StrainLimit::Report report = apply(1);
  EXPECT_EQ(report.sweeps, 1);
  EXPECT_FALSE(report.reached);
  EXPECT_GT(max_strain(model_, state_.positions), 0.101);
}

TEST_P(StretchedSheet, MomentumOfAFreeSheetStays)
{
  const Eigen::Vector3d before = momentum_of(model_, state_);
  const Eigen::RowVector3d middle = model_.masses.transpose() * state_.positions;
  apply(enough_passes());
  EXPECT_LT((momentum_of(model_, state_) - before).norm(), 1e-13);
  EXPECT_LT((model_.masses.transpose() * state_.positions - middle).norm(), 1e-15);
}

TEST_P(StretchedSheet, PinnedNodesStayAndTheRestObeys)
{
  pins_.hold(still_pin("corner", { 0 }, state_.positions));
  const Eigen::RowVector3d corner = state_.positions.row(0);
  const StrainLimit::Report report = apply(enough_passes());
  EXPECT_EQ(state_.positions.row(0), corner);
  EXPECT_TRUE(report.reached);
}

/// The rule written down without blocks or shortcuts: every pass looks at every spring.
void plain_sweeps(const ClothModel& model, double max_strain, int sweeps, Vectors& positions)
{
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    std::vector<std::pair<std::pair<int, int>, double>> springs;
    for (const SpringBatch& batch : model.springs)
    {
      if (batch.kind != SpringKind::flex)
      {
        for_each_spring(batch, [&](int i, int j) { springs.push_back({ { i, j }, batch.rest_length }); });
      }
    }
    if (sweep % 2 == 1)
    {
      std::reverse(springs.begin(), springs.end());
    }
    for (const auto& [ends, rest_length] : springs)
    {
      const auto [i, j] = ends;
      const Eigen::RowVector3d l = positions.row(j) - positions.row(i);
      const double limit = rest_length * (1.0 + max_strain);
      if (l.norm() > rest_length * (1.0 + max_strain * (1.0 + StrainLimit::tolerance)))
      {
        const double sum = 1.0 / model.masses[i] + 1.0 / model.masses[j];
        positions.row(i) += (1.0 - limit / l.norm()) / model.masses[i] / sum * l;
        positions.row(j) -= (1.0 - limit / l.norm()) / model.masses[j] / sum * l;
      }
    }
  }
}

TEST(StrainLimitSweeps, ArePlainSweepsWhateverIsPassedOver)
{
  SheetProperties sheet = small_sheet(9, 71);
  sheet.width = 3.5;
  const ClothModel model = make_sheet(sheet);
  Noise noise;
  ClothState state;
  state.velocities = Vectors::Zero(model.nodes(), 3);
  state.positions = model.rest_positions + 0.004 * noise.vectors(model.nodes());
  state.positions.bottomRows(model.nodes() / 3) *= 1.2;
  Vectors plain = state.positions;
  for (const int sweeps : { 1, 2, 7 })
  {
    plain_sweeps(model, 0.05, sweeps, plain);
    StrainLimit(model, { 0.05, sweeps, LimitSolver::plain_sweeps }).apply(model, Pins(model.nodes()), 0.01, state);
    EXPECT_LT((state.positions - plain).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST_P(StretchedSheet, LeavesFlexSpringsAlone)
{
  SheetProperties sheet = small_sheet();
  sheet.structural.stiffness = 0.0;
  sheet.shear.stiffness = 0.0;
  const ClothModel model = make_sheet(sheet);
  ClothState state;
  state.positions = 2.0 * model.rest_positions;
  state.velocities = Vectors::Zero(model.nodes(), 3);
  EXPECT_FALSE(StrainLimit(model, { 0.1, 5, GetParam() }).apply(model, Pins(model.nodes()), 0.01, state).moved);
}

TEST(StrainLimit, IsNotActiveWithoutALimit)
{
  const ClothModel model = make_sheet(small_sheet());
  EXPECT_FALSE(StrainLimit(model, { 0.0, 5 }).active());
  EXPECT_TRUE(StrainLimit(model, { 0.1, 5 }).active());
}

}  // namespace
}  // namespace cloth
