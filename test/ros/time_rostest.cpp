#include <cmath>
#include <csignal>

#include <geometry_msgs/Vector3Stamped.h>
#include <gtest/gtest.h>
#include <visualization_msgs/MarkerArray.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothStats.h"

#include "listener.h"
#include "node_process.h"
#include "pin_message.h"
#include "state_waits.h"
#include "time_services.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothState;
using cloth_sim::ClothStats;

constexpr double rate = 50.0;

bool same_cloth(const ClothState& left, const ClothState& right)
{
  return left.step == right.step && left.sim_time == right.sim_time && left.positions == right.positions &&
         left.velocities == right.velocities && left.flags == right.flags;
}

/// A small rippled sheet that moves from the start on.
class Time : public testing::Test
{
protected:
  static std::vector<std::string> small_sheet(const std::vector<std::string>& further = {})
  {
    std::vector<std::string> arguments{ "_rate:=50", "_cloth/rows:=8", "_cloth/cols:=8", "_cloth/ripple:=0.02" };
    arguments.insert(arguments.end(), further.begin(), further.end());
    return arguments;
  }

  bool wait_for_sim_time(double time)
  {
    return state_.wait_for_one([=](const ClothState& state) { return std::abs(state.sim_time - time) < 1e-9; });
  }

  Listener<ClothState> state_{ "/cloth_node/state" };
  Listener<ClothStats> stats_{ "/cloth_node/stats" };
};

TEST_F(Time, StartPausedShowsTheStartAndWaits)
{
  NodeProcess node(small_sheet({ "_start_paused:=true" }));
  ASSERT_TRUE(stats_.wait_for(3));
  EXPECT_TRUE(stats_.last().paused);
  ASSERT_TRUE(state_.wait_for(2));
  EXPECT_EQ(state_.last().sim_time, 0.0);
  EXPECT_EQ(state_.last().step, 0u);
  EXPECT_TRUE(same_cloth(state_.all().front(), state_.last()));
  EXPECT_TRUE(set_paused(false).success);
  EXPECT_TRUE(state_.wait_for_one([](const ClothState& state) { return state.sim_time > 0.1; }));
}

TEST_F(Time, APausedClothStandsAndGoesOnFromThere)
{
  NodeProcess node(small_sheet());
  ASSERT_TRUE(state_.wait_for(5));
  ASSERT_TRUE(set_paused(true).success);
  ASSERT_TRUE(stats_.wait_for_one([](const ClothStats& stats) { return stats.paused; }));
  const auto overruns = stats_.last().overruns;
  ASSERT_TRUE(wait_for_standstill(state_));
  state_.forget();
  ASSERT_TRUE(state_.wait_for(3));
  EXPECT_TRUE(same_cloth(state_.all()[0], state_.all()[2]));

  ASSERT_TRUE(set_paused(false).success);
  ASSERT_TRUE(state_.wait_for_more(20));
  for (size_t i = 1; i < state_.all().size(); ++i)
  {
    EXPECT_LT(state_.all()[i].sim_time - state_.all()[i - 1].sim_time, 1.5 / rate);
  }
  ASSERT_TRUE(stats_.wait_for_one([](const ClothStats& stats) { return !stats.paused; }));
  constexpr std::uint32_t half_of_the_pause = 50;
  EXPECT_LT(stats_.last().overruns, overruns + half_of_the_pause);
}

TEST_F(Time, AStepIsExactlyOneTick)
{
  NodeProcess node(small_sheet({ "_start_paused:=true" }));
  ASSERT_TRUE(state_.wait_for(1));
  for (int tick = 1; tick <= 3; ++tick)
  {
    const auto answer = trigger("step");
    EXPECT_TRUE(answer.success) << answer.message;
    EXPECT_TRUE(wait_for_sim_time(tick / rate)) << tick;
  }
  ASSERT_TRUE(stats_.wait_for_more(2));
  EXPECT_DOUBLE_EQ(stats_.last().sim_time, 3.0 / rate);
  EXPECT_TRUE(stats_.last().paused);
  EXPECT_EQ(stats_.last().overruns, 0u);
}

TEST_F(Time, ARunningClothIsNotStepped)
{
  NodeProcess node(small_sheet());
  ASSERT_TRUE(state_.wait_for(1));
  const auto answer = trigger("step");
  EXPECT_FALSE(answer.success);
  EXPECT_NE(answer.message.find("running"), std::string::npos) << answer.message;
}

TEST_F(Time, RequestsArriveWhilePaused)
{
  ros::NodeHandle test;
  const ros::Publisher pins = test.advertise<cloth_sim::Pin>("/cloth_node/pin", 10);
  Listener<visualization_msgs::MarkerArray> markers("/cloth_node/pins");
  NodeProcess node(small_sheet({ "_start_paused:=true" }));
  ASSERT_TRUE(wait_until([&] { return pins.getNumSubscribers() > 0; }));
  ASSERT_TRUE(state_.wait_for(1));
  pins.publish(pin_node("hand", 7, 0));
  EXPECT_TRUE(markers.wait_for_one([](const auto& array) { return array.markers.size() == 3; }));
  EXPECT_TRUE(state_.wait_for_one([](const ClothState& state) { return state.flags[7 * 8] == ClothState::PINNED; }));
  EXPECT_EQ(state_.last().sim_time, 0.0);
}

TEST_F(Time, ResetBringsBackTheFirstState)
{
  ros::NodeHandle test;
  const ros::Publisher pins = test.advertise<cloth_sim::Pin>("/cloth_node/pin", 10);
  const ros::Publisher winds = test.advertise<geometry_msgs::Vector3Stamped>("/cloth_node/wind", 10);
  NodeProcess node(small_sheet({ "_start_paused:=true" }));
  ASSERT_TRUE(wait_until([&] { return pins.getNumSubscribers() > 0 && winds.getNumSubscribers() > 0; }));
  ASSERT_TRUE(state_.wait_for(1));
  const ClothState first = state_.last();
  ASSERT_TRUE(trigger("step").success);
  ASSERT_TRUE(wait_for_sim_time(1.0 / rate));
  const ClothState second = state_.last();

  geometry_msgs::Vector3Stamped wind;
  wind.vector.y = 5.0;
  winds.publish(wind);
  pins.publish(pin_node("hand", 7, 0));
  ASSERT_TRUE(state_.wait_for_one([](const ClothState& state) { return state.flags[7 * 8] == ClothState::PINNED; }));
  ASSERT_TRUE(set_paused(false).success);
  ASSERT_TRUE(state_.wait_for_more(5));
  ASSERT_TRUE(set_paused(true).success);

  ASSERT_TRUE(trigger("reset").success);
  ASSERT_TRUE(wait_for_sim_time(0.0));
  EXPECT_TRUE(same_cloth(state_.last(), first));
  EXPECT_GE(state_.last().header.stamp, second.header.stamp);
  ASSERT_TRUE(trigger("step").success);
  ASSERT_TRUE(wait_for_sim_time(1.0 / rate));
  EXPECT_TRUE(same_cloth(state_.last(), second)) << "the wind is not the scene's";
}

TEST_F(Time, GustsAreTheSameAfterAReset)
{
  NodeProcess node(small_sheet({ "_start_paused:=true", "_air/wind_coupling:=5", "_air/gusts/strength:=10" }));
  ASSERT_TRUE(state_.wait_for(1));
  const auto after_ten_ticks = [&] {
    for (int tick = 1; tick <= 10; ++tick)
    {
      EXPECT_TRUE(trigger("step").success);
    }
    EXPECT_TRUE(wait_for_sim_time(10 / rate));
    return state_.last();
  };
  const ClothState blown = after_ten_ticks();
  ASSERT_TRUE(trigger("reset").success);
  ASSERT_TRUE(wait_for_sim_time(0.0));
  EXPECT_TRUE(same_cloth(after_ten_ticks(), blown));
}

TEST_F(Time, ResetBringsBackAClothThatHasDiverged)
{
  NodeProcess node(small_sheet({ "_start_paused:=true", "_solver/time_step:=0.02", "_solver/method:=symplectic_euler",
                                 "_strain_limit/max_strain:=0", "_springs/structural/stiffness:=5000" }));
  ASSERT_TRUE(state_.wait_for(1));
  const ClothState first = state_.last();
  ASSERT_TRUE(set_paused(false).success);
  ASSERT_TRUE(wait_until([&] { return node.output().find("diverged at") != std::string::npos; })) << node.output();
  ASSERT_TRUE(state_.wait_for_one([](const ClothState& state) { return state.sim_time > 0.0; }));
  ASSERT_TRUE(set_paused(true).success);
  const auto answer = trigger("step");
  EXPECT_FALSE(answer.success);
  EXPECT_NE(answer.message.find("~reset brings the cloth back"), std::string::npos) << answer.message;
  ASSERT_TRUE(set_paused(false).success);

  ASSERT_TRUE(trigger("reset").success);
  ASSERT_TRUE(wait_for_sim_time(0.0));
  EXPECT_TRUE(same_cloth(state_.last(), first));
  EXPECT_TRUE(wait_for_sim_time(1.0 / rate));
}

TEST_F(Time, ASignalEndsAPausedNode)
{
  NodeProcess node(small_sheet({ "_start_paused:=true" }));
  ASSERT_TRUE(state_.wait_for(1));
  node.signal(SIGINT);
  ASSERT_TRUE(node.wait_for_end());
  EXPECT_EQ(node.exit_status(), 0);
}

}  // namespace
}  // namespace cloth
