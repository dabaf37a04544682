#include <cmath>
#include <csignal>

#include <gtest/gtest.h>
#include <rosgraph_msgs/Clock.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/Marker.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothStats.h"

#include "child_process.h"
#include "frame_message.h"
#include "listener.h"
#include "pin_message.h"
#include "time_services.h"

namespace cloth
{
namespace
{

constexpr double rate = 20.0;

/// The tests run in this order on one node; the clock belongs to them.
class SimulatedTime : public testing::Test
{
protected:
  /// Lets simulated time pass in steps of 10 ms until `condition` holds.
  bool drive_until(const std::function<bool()>& condition)
  {
    return wait_until([&] {
      show_time(now_ + ros::Duration(0.01));
      return condition();
    });
  }

  bool drive_for_states(size_t count)
  {
    const size_t enough = state_.all().size() + count;
    return drive_until([&] { return state_.all().size() >= enough; });
  }

  /// The clock stands until no more states come.
  bool stand()
  {
    size_t before = 0;
    do
    {
      before = state_.all().size();
      if (!stats_.wait_for_more(1))
      {
        return false;
      }
    } while (state_.all().size() > before);
    return true;
  }

  void show_time(const ros::Time& time)
  {
    now_ = time;
    rosgraph_msgs::Clock message;
    message.clock = time;
    clock_.publish(message);
  }

  void expect_ticks_of_equal_length()
  {
    for (size_t i = 1; i < state_.all().size(); ++i)
    {
      EXPECT_NEAR(state_.all()[i].sim_time - state_.all()[i - 1].sim_time, 1.0 / rate, 1e-12);
    }
  }

  static ros::Time now_;
  ros::NodeHandle node_;
  ros::Publisher clock_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 10, true);
  Listener<cloth_sim::ClothState> state_{ "/cloth_node/state" };
  Listener<cloth_sim::ClothStats> stats_{ "/cloth_node/stats" };
};

ros::Time SimulatedTime::now_(100.0);

TEST_F(SimulatedTime, BeforeTheFirstClockTheStartIsShownAndStatsCome)
{
  Listener<visualization_msgs::Marker> mesh("/cloth_node/mesh");
  ASSERT_TRUE(stats_.wait_for(2));
  ASSERT_TRUE(mesh.wait_for(1));
  EXPECT_TRUE(state_.all().empty());
  EXPECT_EQ(stats_.last().sim_time, 0.0);
}

TEST_F(SimulatedTime, BeforeTheFirstClockTheServicesAnswer)
{
  ASSERT_TRUE(set_paused(true).success);
  EXPECT_TRUE(trigger("step").success);
  EXPECT_TRUE(state_.wait_for_one([](const cloth_sim::ClothState& state) { return state.sim_time > 0.0; }));
  EXPECT_TRUE(trigger("reload").success);
  EXPECT_TRUE(trigger("reset").success);
  EXPECT_TRUE(state_.wait_for_one([](const cloth_sim::ClothState& state) { return state.sim_time == 0.0; }));
  EXPECT_TRUE(set_paused(false).success);
}

TEST_F(SimulatedTime, BeforeTheFirstClockASignalEndsTheNode)
{
  ChildProcess other({ CLOTH_NODE, "__name:=other" });
  Listener<visualization_msgs::Marker> mesh("/other/mesh");
  ASSERT_TRUE(mesh.wait_for(1));
  other.signal(SIGINT);
  ASSERT_TRUE(wait_until([&] { return other.exit_status().has_value(); }));
  EXPECT_EQ(*other.exit_status(), 0);
}

TEST_F(SimulatedTime, TicksFollowTheClock)
{
  ASSERT_TRUE(drive_for_states(20));
  expect_ticks_of_equal_length();
  for (size_t i = 1; i < state_.all().size(); ++i)
  {
    EXPECT_NEAR((state_.all()[i].header.stamp - state_.all()[i - 1].header.stamp).toSec(), 1.0 / rate, 1e-8);
  }
  EXPECT_LE(state_.last().header.stamp, now_);
}

TEST_F(SimulatedTime, NoTickWhileTheClockStands)
{
  ASSERT_TRUE(drive_for_states(2));
  ASSERT_TRUE(stand());
  const size_t states = state_.all().size();
  ASSERT_TRUE(stats_.wait_for_more(2));
  EXPECT_EQ(state_.all().size(), states);
}

TEST_F(SimulatedTime, WhileTheClockStandsTheServicesAnswer)
{
  ASSERT_TRUE(drive_for_states(2));
  ASSERT_TRUE(stand());
  const double simulated = state_.last().sim_time;
  ASSERT_TRUE(set_paused(true).success);
  EXPECT_TRUE(trigger("step").success);
  EXPECT_TRUE(state_.wait_for_one([=](const cloth_sim::ClothState& state) { return state.sim_time > simulated; }));
  EXPECT_NEAR(state_.last().sim_time, simulated + 1.0 / rate, 1e-12);
  EXPECT_TRUE(trigger("reset").success);
  EXPECT_TRUE(set_paused(false).success);
  EXPECT_TRUE(state_.wait_for_one([](const cloth_sim::ClothState& state) { return state.sim_time == 0.0; }));
}

TEST_F(SimulatedTime, PausedTimeIsNeitherCaughtUpNorCounted)
{
  ASSERT_TRUE(drive_for_states(2));
  ASSERT_TRUE(stand());
  const double simulated = state_.last().sim_time;
  const auto overruns = stats_.last().overruns;
  ASSERT_TRUE(set_paused(true).success);
  show_time(now_ + ros::Duration(1000.0));
  ASSERT_TRUE(stats_.wait_for_one([&](const cloth_sim::ClothStats& stats) { return stats.header.stamp == now_; }));
  EXPECT_EQ(stats_.last().sim_time, simulated);
  ASSERT_TRUE(set_paused(false).success);
  state_.forget();
  ASSERT_TRUE(drive_for_states(3));
  ASSERT_TRUE(stand());
  EXPECT_LT(state_.last().sim_time, simulated + 10.0);
  EXPECT_LT(stats_.last().overruns, overruns + 900 * static_cast<unsigned>(rate));
}

TEST_F(SimulatedTime, TheClothGoesOnWhenTheClockJumpsBackwards)
{
  ASSERT_TRUE(drive_for_states(2));
  ASSERT_TRUE(stand());
  show_time(ros::Time(50.0));
  ASSERT_TRUE(drive_for_states(10));
  expect_ticks_of_equal_length();
  EXPECT_LT(state_.last().header.stamp, ros::Time(60.0));
}

TEST_F(SimulatedTime, APinGoesOnAfterItsFrameWhenTheClockJumpsBackwards)
{
  tf2_ros::TransformBroadcaster broadcaster;
  ros::Publisher pins = node_.advertise<cloth_sim::Pin>("/cloth_node/pin", 10, true);
  pins.publish(attach_node("left", 0, 0, "gripper", false));
  const auto drive_to = [&](double y, const ros::Time& earliest, const ros::Time& latest) {
    return drive_until([&] {
      const Eigen::Isometry3d place(Eigen::Translation3d(-0.5, y, 1.5));
      broadcaster.sendTransform(frame_message("gripper", place, now_));
      return !state_.all().empty() && std::abs(state_.last().positions[1] - y) < 1e-6 &&
             state_.last().header.stamp >= earliest && state_.last().header.stamp <= latest;
    });
  };
  const ros::Time begin = now_;
  const ros::Duration long_enough(10.0);
  EXPECT_TRUE(drive_to(0.2, begin, begin + long_enough));
  EXPECT_TRUE(drive_to(0.3, begin, begin + long_enough));
  const ros::Time back(20.0);
  show_time(back);
  EXPECT_TRUE(drive_to(0.1, back, back + long_enough));
}

TEST_F(SimulatedTime, ALeapForwardIsDroppedAndCounted)
{
  ASSERT_TRUE(drive_for_states(2));
  ASSERT_TRUE(stand());
  const double simulated = state_.last().sim_time;
  const auto overruns = stats_.last().overruns;
  show_time(now_ + ros::Duration(1000.0));
  ASSERT_TRUE(drive_for_states(5));
  ASSERT_TRUE(stand());
  expect_ticks_of_equal_length();
  EXPECT_LT(state_.last().sim_time, simulated + 10.0);
  EXPECT_GT(stats_.last().overruns, overruns + 900 * static_cast<unsigned>(rate));
}

}  // namespace
}  // namespace cloth
