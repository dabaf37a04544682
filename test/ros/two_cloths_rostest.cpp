#include <algorithm>

#include <geometry_msgs/PointStamped.h>
#include <gtest/gtest.h>
#include <ros/master.h>
#include <ros/service.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include "listener.h"
#include "pin_message.h"
#include "state_message.h"
#include "state_waits.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothState;

/// One of the two nodes.
class Cloth
{
public:
  explicit Cloth(const std::string& side)
    : states("/" + side + "/cloth_node/state")
    , pins_(node_.advertise<cloth_sim::Pin>("/" + side + "/cloth_node/pin", 1))
    , points_(node_.advertise<geometry_msgs::PointStamped>("/" + side + "/clicked_point", 1))
    , name_("/" + side + "/cloth_node/")
  {
  }

  Listener<ClothState> states;

  bool lives()
  {
    return wait_until([&] { return pins_.getNumSubscribers() > 0 && points_.getNumSubscribers() > 0; }) &&
           states.wait_for(1);
  }
  bool set_paused(bool paused)
  {
    std_srvs::SetBool service;
    service.request.data = paused ? 1 : 0;
    return ros::service::call(name_ + "set_paused", service) && service.response.success != 0;
  }
  bool reset()
  {
    std_srvs::Trigger service;
    return ros::service::call(name_ + "reset", service) && service.response.success != 0;
  }
  void pin(std::uint32_t row, std::uint32_t col)
  {
    pins_.publish(pin_node("", row, col));
  }
  void release_all()
  {
    pins_.publish(release_pin(""));
  }
  void click(double x, double z)
  {
    geometry_msgs::PointStamped point;
    point.point.x = x;
    point.point.z = z;
    points_.publish(point);
  }

private:
  ros::NodeHandle node_;
  ros::Publisher pins_;
  ros::Publisher points_;
  std::string name_;
};

class TwoCloths : public testing::Test
{
protected:
  void SetUp() override
  {
    ASSERT_TRUE(left_.lives());
    ASSERT_TRUE(right_.lives());
  }

  Cloth left_{ "left" };
  Cloth right_{ "right" };
};

TEST_F(TwoCloths, HaveTopicsOfTheirOwn)
{
  EXPECT_LT(mean_position(left_.states.last()).x(), -0.5);
  EXPECT_GT(mean_position(right_.states.last()).x(), 0.5);
  EXPECT_EQ(left_.states.publishers(), 1u);
  EXPECT_EQ(right_.states.publishers(), 1u);
  ros::master::V_TopicInfo topics;
  ASSERT_TRUE(ros::master::getTopics(topics));
  for (const auto& topic : topics)
  {
    EXPECT_NE(topic.name.find("/cloth_node"), 0u) << topic.name;
  }
}

TEST_F(TwoCloths, OneIsPausedAndResetWithoutTheOther)
{
  ASSERT_TRUE(left_.states.wait_for_one([](const ClothState& state) { return state.sim_time > 0.0; }));
  ASSERT_TRUE(left_.set_paused(true));
  ASSERT_TRUE(wait_for_standstill(left_.states));
  const double paused_at = left_.states.last().sim_time;
  const double later = right_.states.last().sim_time + 0.2;
  ASSERT_TRUE(right_.states.wait_for_one([&](const ClothState& state) { return state.sim_time > later; }));
  ASSERT_TRUE(right_.reset());
  ASSERT_TRUE(right_.states.wait_for_one([&](const ClothState& state) { return state.sim_time == 0.0; }));
  ASSERT_TRUE(right_.states.wait_for_more(5));
  ASSERT_TRUE(left_.states.wait_for_more(1));
  EXPECT_EQ(left_.states.last().sim_time, paused_at);
  EXPECT_TRUE(left_.set_paused(false));
}

TEST_F(TwoCloths, OneIsPinnedAndReleasedWithoutTheOther)
{
  const size_t left_before = pinned_nodes(left_.states.last());
  const size_t right_before = pinned_nodes(right_.states.last());
  left_.pin(31, 16);
  ASSERT_TRUE(
      left_.states.wait_for_one([&](const ClothState& state) { return pinned_nodes(state) == left_before + 1; }));
  left_.click(-0.8, 0.5);
  ASSERT_TRUE(
      left_.states.wait_for_one([&](const ClothState& state) { return pinned_nodes(state) == left_before + 2; }));
  ASSERT_TRUE(right_.states.wait_for_more(5));
  EXPECT_EQ(pinned_nodes(right_.states.last()), right_before);
  right_.release_all();
  ASSERT_TRUE(right_.states.wait_for_one([](const ClothState& state) { return pinned_nodes(state) == 0; }));
  ASSERT_TRUE(left_.states.wait_for_more(5));
  EXPECT_EQ(pinned_nodes(left_.states.last()), left_before + 2);
}

}  // namespace
}  // namespace cloth
