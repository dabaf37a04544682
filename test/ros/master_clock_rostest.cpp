#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rosgraph_msgs/Clock.h>
#include <tf2_ros/transform_broadcaster.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothStats.h"

#include "frame_message.h"
#include "listener.h"
#include "node_process.h"
#include "pin_message.h"
#include "time_services.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothState;
using cloth_sim::ClothStats;
using rosgraph_msgs::Clock;

constexpr double rate = 50.0;

/// A node that makes the ROS time; what it publishes is looked at by its stamps, never by wall time.
class MasterClock : public testing::Test
{
protected:
  static std::vector<std::string> master(const std::vector<std::string>& further = {})
  {
    std::vector<std::string> arguments{ "_clock_mode:=master", "_rate:=50", "_cloth/rows:=8", "_cloth/cols:=8" };
    arguments.insert(arguments.end(), further.begin(), further.end());
    return arguments;
  }

  /// Waits for the node's state; the clock that a node before it has left is forgotten.
  bool wait_for_node()
  {
    const bool is_there = state_.wait_for(1);
    clock_.forget();
    return is_there;
  }

  /// Each message is one period after the one before it, once those of the connection have come: roscpp sends a new
  /// listener the latched one, then what is in its queue, which may be older. A node that goes as fast as it can may be
  /// ahead of a listener by more messages than are kept for it; those that come are whole periods apart then.
  void expect_clock_of_period(double period, bool all_come = true)
  {
    ASSERT_TRUE(wait_for_node());
    ASSERT_TRUE(clock_.wait_for(20));
    clock_.forget();
    ASSERT_TRUE(clock_.wait_for(20));
    for (size_t i = 1; i < clock_.all().size(); ++i)
    {
      const double difference = (clock_.all()[i].clock - clock_.all()[i - 1].clock).toSec();
      const double periods = all_come ? 1.0 : std::max(1.0, std::round(difference / period));
      EXPECT_NEAR(difference, periods * period, 2e-9 * periods);
    }
    ASSERT_TRUE(state_.wait_for_more(20));
    const ClothState& first = state_.all().front();
    for (const ClothState& state : state_.all())
    {
      EXPECT_NEAR((state.header.stamp - first.header.stamp).toSec(), state.sim_time - first.sim_time, 1e-7);
    }
    EXPECT_TRUE(wait_until([&] {
      return std::any_of(clock_.all().begin(), clock_.all().end(),
                         [&](const Clock& clock) { return clock.clock == state_.last().header.stamp; });
    }));
  }

  bool wait_for_sim_time(double time)
  {
    return state_.wait_for_one([=](const ClothState& state) { return std::abs(state.sim_time - time) < 1e-9; });
  }

  Listener<Clock> clock_{ "/clock" };
  Listener<ClothState> state_{ "/cloth_node/state" };
  Listener<ClothStats> stats_{ "/cloth_node/stats" };
};

TEST_F(MasterClock, EveryTickTakesTheTimeOnByWhatItSimulates)
{
  NodeProcess node(master({ "_real_time_factor:=0.5" }));
  expect_clock_of_period(0.5 / rate);
}

TEST_F(MasterClock, AlsoFasterThanTheWallClock)
{
  NodeProcess node(master({ "_real_time_factor:=4" }));
  expect_clock_of_period(4.0 / rate);
}

TEST_F(MasterClock, AlsoAsFastAsItCan)
{
  NodeProcess node(master({ "_real_time_factor:=0" }));
  expect_clock_of_period(1.0 / rate, false);
}

TEST_F(MasterClock, APinFollowsItsFrame)
{
  NodeProcess node(master());
  ASSERT_TRUE(wait_for_node());
  ros::NodeHandle handle;
  ros::Publisher pins = handle.advertise<cloth_sim::Pin>("/cloth_node/pin", 10, true);
  pins.publish(attach_node("left", 0, 0, "gripper", false));
  tf2_ros::TransformBroadcaster broadcaster;
  for (const double y : { 0.1, 0.25, 0.2 })
  {
    EXPECT_TRUE(state_.wait_for_one([&](const ClothState& state) {
      const Eigen::Isometry3d place(Eigen::Translation3d(-0.5, y, 1.5));
      broadcaster.sendTransform(frame_message("gripper", place, state.header.stamp));
      return std::abs(state.positions[1] - y) < 1e-6;
    }));
  }
}

TEST_F(MasterClock, StandsWhilePausedAndIsStepped)
{
  NodeProcess node(master({ "_start_paused:=true" }));
  ASSERT_TRUE(wait_for_node());
  const ros::Time start = state_.last().header.stamp;
  ASSERT_TRUE(stats_.wait_for_more(2));
  EXPECT_TRUE(clock_.all().empty());

  ASSERT_TRUE(trigger("step").success);
  ASSERT_TRUE(wait_for_sim_time(1.0 / rate));
  ASSERT_TRUE(clock_.wait_for(1));
  EXPECT_NEAR((clock_.last().clock - start).toSec(), 1.0 / rate, 2e-9);
  EXPECT_EQ(state_.last().header.stamp, clock_.last().clock);
  ASSERT_TRUE(stats_.wait_for_more(2));
  EXPECT_EQ(clock_.all().size(), 1u);
  Listener<Clock> late("/clock");
  ASSERT_TRUE(late.wait_for(1));
  EXPECT_EQ(late.last().clock, clock_.last().clock) << "who comes late has the time too";
}

TEST_F(MasterClock, DoesNotJumpAtAResetOrReload)
{
  NodeProcess node(master({ "_start_paused:=true" }));
  ASSERT_TRUE(state_.wait_for(1));
  for (const char* const service : { "reset", "reload" })
  {
    ASSERT_TRUE(trigger("step").success);
    ASSERT_TRUE(wait_for_sim_time(1.0 / rate));
    const ros::Time before = state_.last().header.stamp;
    ASSERT_TRUE(trigger(service).success) << service;
    ASSERT_TRUE(wait_for_sim_time(0.0)) << service;
    EXPECT_EQ(state_.last().header.stamp, before) << service;
  }
  ASSERT_TRUE(set_paused(false).success);
  state_.forget();
  expect_clock_of_period(1.0 / rate);
}

TEST_F(MasterClock, IsRefusedWhereAnotherOneIs)
{
  ros::NodeHandle test;
  const ros::Publisher other = test.advertise<Clock>("/clock", 1);
  NodeProcess node(master());
  ASSERT_TRUE(node.wait_for_end());
  EXPECT_EQ(node.exit_status(), 1);
  for (const char* const word : { "clock_mode is master", "/clock is published already", "allowed: follow" })
  {
    EXPECT_NE(node.output().find(word), std::string::npos) << word << " is not in\n" << node.output();
  }
}

}  // namespace
}  // namespace cloth
