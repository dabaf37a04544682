#include <algorithm>
#include <string>

#include <geometry_msgs/Vector3Stamped.h>
#include <gtest/gtest.h>
#include <rosgraph_msgs/Log.h>

#include "listener.h"
#include "state_message.h"
#include "time_services.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothState;

geometry_msgs::Vector3Stamped wind_along_y(double speed)
{
  geometry_msgs::Vector3Stamped message;
  message.vector.y = speed;
  return message;
}

class Wind : public testing::Test
{
protected:
  long warnings_with(const std::string& text) const
  {
    return std::count_if(log_.all().begin(), log_.all().end(), [&](const rosgraph_msgs::Log& entry) {
      return entry.level == rosgraph_msgs::Log::WARN && entry.msg.find(text) != std::string::npos;
    });
  }

  ros::NodeHandle node_;
  Listener<rosgraph_msgs::Log> log_{ "/rosout" };
};

TEST_F(Wind, OfTheSceneBlowsAgainWhenNoneCameByTopicForLong)
{
  Listener<ClothState> state("/cloth_node/state");
  ros::Publisher winds = node_.advertise<geometry_msgs::Vector3Stamped>("/cloth_node/wind", 10);
  ASSERT_TRUE(wait_until([&] { return winds.getNumSubscribers() > 0 && log_.publishers() >= 3; }));
  ASSERT_TRUE(state.wait_for_one([&](const ClothState& last) {
    winds.publish(wind_along_y(-6.0));
    return mean_position(last).y() < -0.1;
  }));
  const std::string warning = "no message on ~wind for more than wind_timeout, 1.0 s";
  EXPECT_TRUE(wait_until([&] { return warnings_with(warning) > 0; }));
  EXPECT_TRUE(state.wait_for_one([](const ClothState& last) { return mean_position(last).y() > 0.01; }))
      << "the scene's wind blows the other way";
  ASSERT_TRUE(state.wait_for_more(100));
  EXPECT_EQ(warnings_with(warning), 1);
  EXPECT_EQ(trigger("reset").success, 1);
}

TEST_F(Wind, ThatHasNoEffectIsReportedOnce)
{
  Listener<ClothState> state("/uncoupled/state");
  ros::Publisher winds = node_.advertise<geometry_msgs::Vector3Stamped>("/uncoupled/wind", 10);
  ASSERT_TRUE(wait_until([&] { return winds.getNumSubscribers() > 0 && log_.publishers() >= 3; }));
  const std::string warning = "~wind has no effect: air.wind_coupling is 0";
  for (int k = 0; k < 5; ++k)
  {
    winds.publish(wind_along_y(1.0));
    ASSERT_TRUE(state.wait_for_more(2));
  }
  ASSERT_TRUE(wait_until([&] { return warnings_with(warning) > 0; }));
  ASSERT_TRUE(state.wait_for_more(5));
  EXPECT_EQ(warnings_with(warning), 1);
}

}  // namespace
}  // namespace cloth
