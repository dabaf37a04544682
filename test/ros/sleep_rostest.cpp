// A settled sheet sleeps in the node: its ticks go on, and requests wake it.

#include <string>

#include <geometry_msgs/Vector3Stamped.h>
#include <gtest/gtest.h>

#include "cloth_sim/ClothStats.h"

#include "listener.h"
#include "pin_message.h"
#include "state_message.h"
#include "time_services.h"
#include "tuning_client.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothState;
using cloth_sim::ClothStats;

bool is_asleep(const ClothStats& stats)
{
  return stats.plan.find("asleep since 0.0 s") != std::string::npos && stats.step == 0;
}

class Sleep : public testing::Test
{
protected:
  void SetUp() override
  {
    ASSERT_EQ(trigger("reload").success, 1);
    ASSERT_TRUE(stats_.wait_for_one(is_asleep));
    ASSERT_TRUE(state_.wait_for_more(1));
    rest_ = state_.last();
  }

  /// How far the middle of the sheet goes, m, until somebody sees it.
  bool moves(double way)
  {
    return state_.wait_for_one(
        [&](const ClothState& state) { return (mean_position(state) - mean_position(rest_)).norm() > way; });
  }

  ros::NodeHandle node_;
  Listener<ClothState> state_{ "/cloth_node/state" };
  Listener<ClothStats> stats_{ "/cloth_node/stats" };
  ClothState rest_;
};

TEST_F(Sleep, LeavesTheTicksToGoOn)
{
  state_.forget();
  ASSERT_TRUE(state_.wait_for(100));
  for (size_t i = 1; i < 100; ++i)
  {
    EXPECT_EQ(state_.all()[i].positions, rest_.positions);
    EXPECT_GT(state_.all()[i].sim_time, state_.all()[i - 1].sim_time);
  }
  ASSERT_TRUE(stats_.wait_for_more(2));
  EXPECT_TRUE(is_asleep(stats_.last()));
}

TEST_F(Sleep, EndsByWind)
{
  ros::Publisher winds = node_.advertise<geometry_msgs::Vector3Stamped>("/cloth_node/wind", 10);
  ASSERT_TRUE(wait_until([&] { return winds.getNumSubscribers() > 0; }));
  geometry_msgs::Vector3Stamped wind;
  winds.publish(wind);
  ASSERT_TRUE(stats_.wait_for_more(2));
  EXPECT_TRUE(is_asleep(stats_.last())) << "no wind is what there was";
  wind.vector.y = 4.0;
  winds.publish(wind);
  EXPECT_TRUE(moves(0.05));
}

TEST_F(Sleep, EndsByAPin)
{
  ros::Publisher pins = node_.advertise<cloth_sim::Pin>("/cloth_node/pin", 10);
  ASSERT_TRUE(wait_until([&] { return pins.getNumSubscribers() > 0; }));
  pins.publish(release_pin("left"));
  EXPECT_TRUE(moves(0.1));
}

TEST_F(Sleep, EndsByAChangeOfALiveKey)
{
  ASSERT_TRUE(Change().set("gravity_z", -20.0).ask());
  EXPECT_TRUE(stats_.wait_for_one(
      [](const ClothStats& stats) { return stats.step > 0 && stats.plan.find("asleep") == std::string::npos; }));
}

}  // namespace
}  // namespace cloth
