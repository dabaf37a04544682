#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <geometry_msgs/WrenchStamped.h>
#include <gtest/gtest.h>

#include "cloth_sim/ClothState.h"

#include "listener.h"
#include "pin_message.h"
#include "state_waits.h"
#include "time_services.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothState;
using geometry_msgs::WrenchStamped;

constexpr double weight = 0.4 * 9.81;

Eigen::Vector3d force_of(const WrenchStamped& message)
{
  return { message.wrench.force.x, message.wrench.force.y, message.wrench.force.z };
}

/// A settled sheet that hangs from its two upper corners.
class Wrenches : public testing::Test
{
protected:
  void SetUp() override
  {
    ASSERT_TRUE(wait_until([&] { return pins_.getNumSubscribers() > 0 && state_.publishers() > 0; }));
    ASSERT_TRUE(start_over(state_));
  }

  /// The first wrench on the holder of `pin` for which there is one of `other_pin` at the same time: both.
  static std::pair<const WrenchStamped*, const WrenchStamped*> at_the_same_time(const Listener<WrenchStamped>& one,
                                                                                const Listener<WrenchStamped>& other)
  {
    for (const WrenchStamped& message : one.all())
    {
      for (const WrenchStamped& candidate : other.all())
      {
        if (candidate.header.stamp == message.header.stamp)
        {
          return { &message, &candidate };
        }
      }
    }
    return { nullptr, nullptr };
  }

  ros::NodeHandle node_;
  Listener<ClothState> state_{ "/cloth_node/state" };
  ros::Publisher pins_ = node_.advertise<cloth_sim::Pin>("/cloth_node/pin", 100);
};

TEST_F(Wrenches, AtRestCarryTheWeight)
{
  Listener<WrenchStamped> left("/cloth_node/pins/left/wrench");
  Listener<WrenchStamped> right("/cloth_node/pins/right/wrench");
  ASSERT_TRUE(wait_until([&] { return at_the_same_time(left, right).first != nullptr; }));
  const auto [on_left, on_right] = at_the_same_time(left, right);
  const Eigen::Vector3d sum = force_of(*on_left) + force_of(*on_right);
  EXPECT_LT((sum - Eigen::Vector3d(0.0, 0.0, -weight)).norm(), 0.01 * weight) << sum.transpose();
  EXPECT_GT(force_of(*on_left).x(), 0.05 * weight) << "the sheet pulls its left corner to the right";
  EXPECT_LT(force_of(*on_right).x(), -0.05 * weight);
  EXPECT_EQ(on_left->header.frame_id, "hall");
  EXPECT_TRUE(std::any_of(state_.all().begin(), state_.all().end(),
                          [&](const ClothState& state) { return state.header.stamp == on_left->header.stamp; }));
}

TEST_F(Wrenches, ComeOnceATick)
{
  Listener<WrenchStamped> left("/cloth_node/pins/left/wrench");
  ASSERT_TRUE(left.wait_for(10));
  ASSERT_TRUE(
      state_.wait_for_one([&](const ClothState& state) { return state.header.stamp >= left.last().header.stamp; }));
  for (const WrenchStamped& message : left.all())
  {
    EXPECT_EQ(std::count_if(left.all().begin(), left.all().end(),
                            [&](const auto& other) { return other.header.stamp == message.header.stamp; }),
              1);
    EXPECT_EQ(std::count_if(state_.all().begin(), state_.all().end(),
                            [&](const auto& state) { return state.header.stamp == message.header.stamp; }),
              1);
  }
}

TEST_F(Wrenches, ComeAndGoWithTheirPins)
{
  Listener<WrenchStamped> hand("/cloth_node/pins/hand/wrench");
  pins_.publish(pin_node("hand", 8, 0));
  EXPECT_TRUE(hand.wait_for(3));
  EXPECT_EQ(hand.publishers(), 1u);
  pins_.publish(release_pin("hand"));
  EXPECT_TRUE(wait_until([&] { return hand.publishers() == 0; }));
  pins_.publish(pin_node("hand", 8, 0));
  hand.forget();
  EXPECT_TRUE(hand.wait_for(1));
  ASSERT_TRUE(trigger("reset").success);
  EXPECT_TRUE(wait_until([&] { return hand.publishers() == 0; }));
}

}  // namespace
}  // namespace cloth
