#include "cloth_sim/constraints/strain_limit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "cloth_sim/forces/springs.h"
#include "cloth_sim/simulation/energy.h"
#include "support.h"

namespace cloth
{
namespace
{

/// Two masses on one spring of 1 m along z.
class OneSpring : public testing::Test
{
protected:
  void stretch_to(double length)
  {
    state_.positions = model_.rest_positions;
    state_.positions(1, 2) = -length;
    state_.velocities = Vectors::Zero(2, 3);
  }

  double strain() const
  {
    return (state_.positions.row(1) - state_.positions.row(0)).norm() - 1.0;
  }

  ClothModel model_ = make_sheet(chain(2, 100.0, 0.5));
  Pins pins_{ 2 };
  ClothState state_;
};

TEST_F(OneSpring, IsShortenedToTheLimitExactly)
{
  stretch_to(1.7);
  const StrainLimit::Report report = StrainLimit(model_, { 0.1, 5 }).apply(model_, pins_, 0.01, state_);
  EXPECT_TRUE(report.moved);
  EXPECT_TRUE(report.reached);
  EXPECT_NEAR(strain(), 0.1, 1e-15);
}

TEST_F(OneSpring, EqualMassesShareTheShiftEqually)
{
  stretch_to(1.7);
  StrainLimit(model_, { 0.1, 5 }).apply(model_, pins_, 0.01, state_);
  EXPECT_NEAR(state_.positions(0, 2), -0.3, 1e-15);
  EXPECT_NEAR(state_.positions(1, 2), -1.4, 1e-15);
}

TEST_F(OneSpring, UnequalMassesShareItByInverseMass)
{
  model_.masses << 3.0, 1.0;
  stretch_to(1.7);
  StrainLimit(model_, { 0.1, 5 }).apply(model_, pins_, 0.01, state_);
  EXPECT_NEAR(state_.positions(0, 2), -0.15, 1e-15);
  EXPECT_NEAR(state_.positions(1, 2), -1.25, 1e-15);
}

TEST_F(OneSpring, APinnedEndStays)
{
  stretch_to(1.7);
  pins_.hold(still_pin("top", { 0 }, state_.positions));
  StrainLimit(model_, { 0.1, 5 }).apply(model_, pins_, 0.01, state_);
  EXPECT_EQ(state_.positions(0, 2), 0.0);
  EXPECT_NEAR(state_.positions(1, 2), -1.1, 1e-15);
  EXPECT_TRUE(state_.velocities.row(0).isZero(0.0));
}

TEST_F(OneSpring, BetweenTwoPinsIsLeftAlone)
{
  stretch_to(1.7);
  pins_.hold(still_pin("both", { 0, 1 }, state_.positions));
  const StrainLimit::Report report = StrainLimit(model_, { 0.1, 5 }).apply(model_, pins_, 0.01, state_);
  EXPECT_FALSE(report.moved);
  EXPECT_EQ(report.sweeps, 1);
  EXPECT_NEAR(strain(), 0.7, 1e-15);
}

TEST_F(OneSpring, VelocityFollowsTheCorrection)
{
  stretch_to(1.7);
  state_.velocities.col(0).setOnes();
  const Vectors before = state_.positions;
  StrainLimit(model_, { 0.1, 5 }).apply(model_, pins_, 0.01, state_);
  Vectors expected = (state_.positions - before) / 0.01;
  expected.col(0).array() += 1.0;
  EXPECT_TRUE(state_.velocities.isApprox(expected, 1e-14));
}

TEST_F(OneSpring, BelowTheLimitAndUnderCompressionNothingHappens)
{
  for (const double length : { 1.0999, 1.0, 0.2 })
  {
    stretch_to(length);
    const ClothState before = state_;
    const StrainLimit::Report report = StrainLimit(model_, { 0.1, 5 }).apply(model_, pins_, 0.01, state_);
    EXPECT_FALSE(report.moved);
    EXPECT_EQ(state_.positions, before.positions);
    EXPECT_EQ(state_.velocities, before.velocities);
  }
}

class StretchedSheet : public testing::Test
{
protected:
  StretchedSheet()
  {
    Noise noise;
    state_.positions = 1.3 * model_.rest_positions + 0.01 * noise.vectors(model_.nodes());
    state_.velocities = noise.vectors(model_.nodes());
  }

  const ClothModel model_ = make_sheet(small_sheet());
  Pins pins_{ model_.nodes() };
  ClothState state_;
};

TEST_F(StretchedSheet, SweepsReachTheLimitEverywhere)
{
  const StrainLimit::Report report = StrainLimit(model_, { 0.1, 1000 }).apply(model_, pins_, 0.01, state_);
  EXPECT_TRUE(report.reached);
  EXPECT_LE(max_strain(model_, state_.positions), 0.1 * (1.0 + StrainLimit::tolerance) + 1e-15);
}

TEST_F(StretchedSheet, FewSweepsDoNotAndSaySo)
{
  const StrainLimit::Report report = StrainLimit(model_, { 0.1, 1 }).apply(model_, pins_, 0.01, state_);
  EXPECT_EQ(report.sweeps, 1);
  EXPECT_FALSE(report.reached);
  EXPECT_GT(max_strain(model_, state_.positions), 0.101);
}

TEST_F(StretchedSheet, MomentumOfAFreeSheetStays)
{
  const Eigen::Vector3d before = momentum_of(model_, state_);
  const Eigen::RowVector3d middle = model_.masses.transpose() * state_.positions;
  StrainLimit(model_, { 0.1, 1000 }).apply(model_, pins_, 0.01, state_);
  EXPECT_LT((momentum_of(model_, state_) - before).norm(), 1e-13);
  EXPECT_LT((model_.masses.transpose() * state_.positions - middle).norm(), 1e-15);
}

TEST_F(StretchedSheet, PinnedNodesStayAndTheRestObeys)
{
  pins_.hold(still_pin("corner", { 0 }, state_.positions));
  const Eigen::RowVector3d corner = state_.positions.row(0);
  const StrainLimit::Report report = StrainLimit(model_, { 0.1, 1000 }).apply(model_, pins_, 0.01, state_);
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
    StrainLimit(model, { 0.05, sweeps }).apply(model, Pins(model.nodes()), 0.01, state);
    EXPECT_LT((state.positions - plain).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(StrainLimitSweeps, LeaveFlexSpringsAlone)
{
  SheetProperties sheet = small_sheet();
  sheet.structural.stiffness = 0.0;
  sheet.shear.stiffness = 0.0;
  const ClothModel model = make_sheet(sheet);
  ClothState state;
  state.positions = 2.0 * model.rest_positions;
  state.velocities = Vectors::Zero(model.nodes(), 3);
  EXPECT_FALSE(StrainLimit(model, { 0.1, 5 }).apply(model, Pins(model.nodes()), 0.01, state).moved);
}

TEST(StrainLimitSweeps, AreNotActiveWithoutALimit)
{
  const ClothModel model = make_sheet(small_sheet());
  EXPECT_FALSE(StrainLimit(model, { 0.0, 5 }).active());
  EXPECT_TRUE(StrainLimit(model, { 0.1, 5 }).active());
}

}  // namespace
}  // namespace cloth
