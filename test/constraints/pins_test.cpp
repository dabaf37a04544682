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

  /// The velocity of the first of the pin's nodes.
  Eigen::Vector3d velocity_of(const std::string& name, double time)
  {
    pins_.impose_velocities(time, velocities_);
    return velocities_.row(pins_.find(name)->nodes.front());
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
  const Eigen::Vector3d start = positions_.row(2);
  EXPECT_EQ(pin.middle(0.0), start);
  const double time = 1.3;
  const double expected = std::sin(2.0 * M_PI * 0.7 * time + 0.4) - std::sin(0.4);
  EXPECT_TRUE((pin.middle(time) - start).isApprox(expected * Eigen::Vector3d(0.1, 0.0, -0.2), 1e-14));
  pins_.hold(pin);
  pins_.impose(time, positions_, velocities_);
  EXPECT_EQ(positions_.row(2).transpose(), pin.middle(time));
  const Eigen::Vector3d slope = (pin.middle(time + 1e-6) - pin.middle(time - 1e-6)) / 2e-6;
  EXPECT_TRUE(velocities_.row(2).transpose().isApprox(slope, 1e-8));
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
  const Eigen::Vector3d velocity(0.6, 0.0, -1.2);
  EXPECT_TRUE(velocity_of("hand", 1.99).isZero(0.0));
  for (const double time : { 2.0, 2.25, 2.5, std::nextafter(2.5, 3.0) })
  {
    EXPECT_TRUE(velocity_of("hand", time).isApprox(velocity)) << time;
  }
  EXPECT_TRUE(velocity_of("hand", 2.51).isZero(0.0));
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

/// A bar of two nodes along x, a metre long, that turns by a right angle about the z axis through a point beside it
/// while that point is lifted, between 1 s and 3 s.
class TurnedBar : public PinsOnSixNodes
{
protected:
  TurnedBar()
  {
    positions_.row(1) << 1.0, 0.0, 0.0;
    positions_.row(4) << 2.0, 0.0, 0.0;
    pins_.hold(still_pin("bar", { 1, 4 }, positions_));
    const Eigen::Translation3d lift(0.0, 0.0, 0.8);
    const Eigen::Translation3d to_pivot(pivot_);
    placement_ = lift * to_pivot * Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitZ()) * to_pivot.inverse();
    EXPECT_TRUE(pins_.carry("bar", placement_, pivot_, 1.0, 3.0));
  }

  void expect_at(double time, const Eigen::RowVector3d& one, const Eigen::RowVector3d& other)
  {
    pins_.impose(time, positions_, velocities_);
    EXPECT_LT((positions_.row(1) - one).norm(), 1e-14) << "at " << time << " s: " << positions_.row(1);
    EXPECT_LT((positions_.row(4) - other).norm(), 1e-14) << "at " << time << " s: " << positions_.row(4);
    EXPECT_LT((pins_.find("bar")->middle(time).transpose() - 0.5 * (one + other)).norm(), 1e-14);
  }

  const Eigen::Vector3d pivot_{ 0.0, 1.0, 0.0 };
  Eigen::Isometry3d placement_;
};

TEST_F(TurnedBar, GoesOnArcsAboutItsRisingPivot)
{
  expect_at(0.5, { 1.0, 0.0, 0.0 }, { 2.0, 0.0, 0.0 });
  expect_at(1.0, { 1.0, 0.0, 0.0 }, { 2.0, 0.0, 0.0 });
  // At half of the turn the arms (1, -1) and (2, -1) are (sqrt 2, 0) and (3, 1)/sqrt 2.
  expect_at(2.0, { std::sqrt(2.0), 1.0, 0.4 }, { 3.0 / std::sqrt(2.0), 1.0 + 1.0 / std::sqrt(2.0), 0.4 });
  expect_at(3.0, { 1.0, 2.0, 0.8 }, { 1.0, 3.0, 0.8 });
  expect_at(9.0, { 1.0, 2.0, 0.8 }, { 1.0, 3.0, 0.8 });
}

TEST_F(TurnedBar, HasTheVelocitiesOfItsWay)
{
  const double rate = M_PI_4;
  pins_.impose(2.0, positions_, velocities_);
  EXPECT_LT((velocities_.row(1) - Eigen::RowVector3d(0.0, std::sqrt(2.0) * rate, 0.4)).norm(), 1e-14);
  EXPECT_LT((velocities_.row(4) - Eigen::RowVector3d(-rate / std::sqrt(2.0), 3.0 * rate / std::sqrt(2.0), 0.4)).norm(),
            1e-14);
  pins_.impose(3.0, positions_, velocities_);
  EXPECT_LT((velocities_.row(1) - Eigen::RowVector3d(-rate, rate, 0.4)).norm(), 1e-14);
  pins_.impose(3.01, positions_, velocities_);
  EXPECT_TRUE(velocities_.row(1).isZero(0.0));
}

TEST_F(TurnedBar, KeepsItsTurnWhenItIsCarriedOn)
{
  ASSERT_TRUE(pins_.carry("bar", Eigen::Vector3d(0.0, 0.0, 0.0), 3.0, 4.0));
  expect_at(3.0, { 1.0, 2.0, 0.8 }, { 1.0, 3.0, 0.8 });
  expect_at(3.5, { 0.5, 0.75, 0.4 }, { 0.5, 1.75, 0.4 });
  expect_at(4.0, { 0.0, -0.5, 0.0 }, { 0.0, 0.5, 0.0 });
}

TEST_F(TurnedBar, TurnsBackFromWhereItIsOnTheWay)
{
  ASSERT_TRUE(pins_.carry("bar", Eigen::Isometry3d::Identity(), Eigen::Vector3d(1.5, 0.0, 0.0), 2.0, 2.5));
  expect_at(2.0, { std::sqrt(2.0), 1.0, 0.4 }, { 3.0 / std::sqrt(2.0), 1.0 + 1.0 / std::sqrt(2.0), 0.4 });
  expect_at(2.5, { 1.0, 0.0, 0.0 }, { 2.0, 0.0, 0.0 });
  EXPECT_FALSE(pins_.carry("nobody", Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero(), 2.0, 2.5));
}

TEST_F(TurnedBar, ThatLosesANodeGoesOnWithTheOther)
{
  pins_.hold(still_pin("thief", { 1 }, positions_));
  pins_.impose(2.0, positions_, velocities_);
  EXPECT_LT(
      (positions_.row(4) - Eigen::RowVector3d(3.0, std::sqrt(2.0) + 1.0, 0.4 * std::sqrt(2.0)) / std::sqrt(2.0)).norm(),
      1e-14);
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
