#include "cloth_sim/forces/air.h"

#include <gtest/gtest.h>

#include "support.h"

namespace cloth
{
namespace
{

class AirOnASheet : public testing::Test
{
protected:
  AirOnASheet()
  {
    Noise noise;
    positions_ = model_.rest_positions + 0.02 * noise.vectors(model_.nodes());
    velocities_ = noise.vectors(model_.nodes());
    node_normals(model_, positions_, normals_);
  }

  Vectors forces_of(const Air& air, const Vectors& velocities) const
  {
    Vectors forces = Vectors::Zero(model_.nodes(), 3);
    air.add_forces(model_, 0.0, positions_, velocities, forces);
    return forces;
  }

  const ClothModel model_ = make_sheet(small_sheet());
  const AirProperties properties_{ 0.4, 1.7, { 1.0, 2.0, -0.5 }, {} };
  Vectors positions_;
  Vectors velocities_;
  Vectors normals_;
};

TEST_F(AirOnASheet, ForceIsProvotsAtEveryNode)
{
  const Vectors forces = forces_of(Air(properties_), velocities_);
  for (int i = 0; i < model_.nodes(); ++i)
  {
    const Eigen::RowVector3d v = velocities_.row(i);
    const Eigen::RowVector3d n = normals_.row(i);
    const Eigen::RowVector3d expected =
        model_.areas[i] * (-0.4 * v + 1.7 * n.dot(properties_.wind.transpose() - v) * n);
    EXPECT_TRUE(forces.row(i).isApprox(expected, 1e-13));
  }
}

TEST_F(AirOnASheet, WindAlongASheetDoesNothing)
{
  Vectors forces = Vectors::Zero(model_.nodes(), 3);
  const Air air({ 0.0, 1.7, { 3.0, 0.0, 4.0 }, {} });
  air.add_forces(model_, 0.0, model_.rest_positions, forces, forces);
  EXPECT_LT(forces.cwiseAbs().maxCoeff(), 1e-15);
}

TEST_F(AirOnASheet, WithoutCouplingOnlyDragIsLeft)
{
  const Vectors forces = forces_of(Air({ 0.4, 0.0, { 1.0, 2.0, -0.5 }, {} }), velocities_);
  EXPECT_TRUE(forces.isApprox((velocities_.array().colwise() * (-0.4 * model_.areas.array())).matrix(), 1e-14));
}

TEST_F(AirOnASheet, ImplicitDampingSolvesItsEquation)
{
  const Air air(properties_);
  const double h = 0.3;
  Vectors after = velocities_;
  air.damp_implicitly(model_, 0.0, positions_, h, after);
  // m (v_after - v) = h f(v_after)
  const Vectors change = (after - velocities_).array().colwise() * model_.masses.array();
  EXPECT_TRUE(change.isApprox(h * forces_of(air, after), 1e-12));
}

TEST_F(AirOnASheet, DampingRateIsTheFastestOfAnyNode)
{
  const double slowing = (0.4 + 1.7) * (model_.areas.array() / model_.masses.array()).maxCoeff();
  EXPECT_DOUBLE_EQ(Air(properties_).damping_rate(model_), slowing);
  EXPECT_EQ(Air(vacuum()).damping_rate(model_), 0.0);
  EXPECT_DOUBLE_EQ(Air(properties_).least_damping_rate(model_), 0.4 * model_.areas[0] / model_.masses[0]);
}

TEST(AirOnAChain, IsDragAlone)
{
  const ClothModel model = make_sheet(small_sheet(6, 1));
  const Air air({ 0.4, 1.7, { 1.0, 2.0, -0.5 }, {} });
  Vectors forces = Vectors::Zero(model.nodes(), 3);
  air.add_forces(model, 0.0, model.rest_positions, Vectors::Zero(model.nodes(), 3), forces);
  EXPECT_TRUE(forces.isZero(0.0));
  EXPECT_DOUBLE_EQ(air.damping_rate(model), 0.4 * model.areas[0] / model.masses[0]);
}

TEST_F(AirOnASheet, DampingProductIsTheDerivativeByTheVelocities)
{
  const Air air(properties_);
  Noise noise;
  const Vectors u = noise.vectors(model_.nodes());
  Vectors product = Vectors::Zero(model_.nodes(), 3);
  air.add_damping_product(model_, normals_, u, product);
  const Vectors change = forces_of(air, velocities_ + u) - forces_of(air, velocities_);
  EXPECT_LT((product + change).norm(), 1e-12 * product.norm());
}

}  // namespace
}  // namespace cloth
