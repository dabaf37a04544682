#include "cloth_sim/constraints/pins.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support.h"

namespace cloth
{
namespace
{

class PinsOnSixNodes : public testing::Test
{
protected:
  PinsOnSixNodes()
  {
    Noise noise;
    positions_ = noise.vectors(6);
    velocities_ = noise.vectors(6);
  }

  Vectors positions_;
  Vectors velocities_;
  Pins pins_{ 6 };
};

TEST_F(PinsOnSixNodes, HeldNodesAreWhereTheyWereAndAtRest)
{
  const Vectors before = positions_;
  pins_.hold(still_pin("hand", { 1, 4 }, positions_));
  positions_.setOnes();
  pins_.impose(3.0, positions_, velocities_);
  for (const int node : { 1, 4 })
  {
    EXPECT_TRUE(pins_.holds(node));
    EXPECT_EQ(positions_.row(node), before.row(node));
    EXPECT_TRUE(velocities_.row(node).isZero(0.0));
  }
  EXPECT_FALSE(pins_.holds(0));
  EXPECT_EQ(positions_.row(0), Eigen::RowVector3d::Ones());
}

TEST_F(PinsOnSixNodes, OscillationStartsWhereThePinIsAndHasItsOwnVelocity)
{
  Pin pin = still_pin("hand", { 2 }, positions_);
  pin.oscillation = { { 0.1, 0.0, -0.2 }, 0.7, 0.4 };
  EXPECT_TRUE(pin.displacement(0.0).isZero(0.0));
  const double time = 1.3;
  const double expected = std::sin(2.0 * M_PI * 0.7 * time + 0.4) - std::sin(0.4);
  EXPECT_TRUE(pin.displacement(time).isApprox(expected * Eigen::Vector3d(0.1, 0.0, -0.2), 1e-14));
  const Eigen::Vector3d slope = (pin.displacement(time + 1e-6) - pin.displacement(time - 1e-6)) / 2e-6;
  EXPECT_TRUE(pin.velocity(time).isApprox(slope, 1e-8));
}

TEST_F(PinsOnSixNodes, CarryTakesTheMiddleThereInAStraightLineAndKeepsItThere)
{
  pins_.hold(still_pin("hand", { 1, 4 }, positions_));
  const Eigen::Vector3d start = pins_.find("hand")->middle(0.0);
  const Eigen::Vector3d target = start + Eigen::Vector3d(0.3, 0.0, -0.6);
  ASSERT_TRUE(pins_.carry("hand", target, 2.0, 2.5));
  const Pin& hand = *pins_.find("hand");
  EXPECT_TRUE(hand.middle(2.0).isApprox(start));
  EXPECT_TRUE(hand.middle(2.25).isApprox(0.5 * (start + target)));
  EXPECT_TRUE(hand.middle(2.5).isApprox(target));
  EXPECT_TRUE(hand.middle(9.0).isApprox(target));
  EXPECT_TRUE(hand.velocity(2.25).isApprox(Eigen::Vector3d(0.6, 0.0, -1.2)));
  EXPECT_TRUE(hand.velocity(2.5).isApprox(Eigen::Vector3d(0.6, 0.0, -1.2)));
  EXPECT_TRUE(hand.velocity(2.51).isZero(0.0));
  EXPECT_FALSE(pins_.carry("foot", target, 2.0, 2.5));
}

TEST_F(PinsOnSixNodes, CarriedAgainOnTheWayGoesOnFromWhereItIs)
{
  pins_.hold(still_pin("hand", { 0 }, positions_));
  const Eigen::Vector3d start = pins_.find("hand")->middle(0.0);
  pins_.carry("hand", start + Eigen::Vector3d::UnitX(), 0.0, 1.0);
  pins_.carry("hand", start, 0.5, 1.0);
  EXPECT_TRUE(pins_.find("hand")->middle(0.5).isApprox(start + 0.5 * Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(pins_.find("hand")->middle(1.0).isApprox(start));
}

TEST_F(PinsOnSixNodes, ReleaseFreesNodesAndKeepsTheirVelocity)
{
  Pin pin = still_pin("hand", { 2 }, positions_);
  pin.oscillation = { { 0.1, 0.0, 0.0 }, 1.0, 0.0 };
  pins_.hold(pin);
  pins_.impose(0.0, positions_, velocities_);
  const Eigen::RowVector3d moving = velocities_.row(2);
  EXPECT_GT(moving.x(), 0.0);
  EXPECT_TRUE(pins_.release("hand"));
  EXPECT_FALSE(pins_.release("hand"));
  pins_.impose(1.0, positions_, velocities_);
  EXPECT_FALSE(pins_.holds(2));
  EXPECT_EQ(velocities_.row(2), moving);
}

TEST_F(PinsOnSixNodes, ANodeIsInOnePinAndTheLatestHasIt)
{
  pins_.hold(still_pin("hand", { 1, 2 }, positions_));
  pins_.hold(still_pin("foot", { 2, 3 }, positions_));
  EXPECT_EQ(pins_.find("hand")->nodes, std::vector<int>{ 1 });
  EXPECT_EQ(pins_.find("hand")->held.row(0), positions_.row(1));
  EXPECT_EQ(pins_.find("foot")->nodes, (std::vector<int>{ 2, 3 }));
  pins_.hold(still_pin("nose", { 1 }, positions_));
  EXPECT_EQ(pins_.find("hand"), nullptr);
}

TEST_F(PinsOnSixNodes, APinOfTheSameNameTakesThePlaceOfTheOld)
{
  pins_.hold(still_pin("hand", { 1, 2 }, positions_));
  pins_.hold(still_pin("hand", { 5 }, positions_));
  EXPECT_EQ(pins_.all().size(), 1u);
  EXPECT_FALSE(pins_.holds(1));
  EXPECT_TRUE(pins_.holds(5));
  pins_.release_all();
  EXPECT_TRUE(pins_.all().empty());
  EXPECT_FALSE(pins_.holds(5));
}

TEST_F(PinsOnSixNodes, ClearingZeroesHeldRowsAlone)
{
  pins_.hold(still_pin("hand", { 1 }, positions_));
  Vectors rows = Vectors::Ones(6, 3);
  pins_.clear_held(rows);
  EXPECT_TRUE(rows.row(1).isZero(0.0));
  EXPECT_EQ(rows.sum(), 15.0);
}

}  // namespace
}  // namespace cloth
