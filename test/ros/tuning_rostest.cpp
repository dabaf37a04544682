#include <cmath>
#include <limits>

#include <dynamic_reconfigure/Config.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <gtest/gtest.h>
#include <ros/param.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothStats.h"
#include "cloth_sim/ClothTopology.h"

#include "listener.h"
#include "node_process.h"
#include "pin_message.h"
#include "time_services.h"
#include "tuning_client.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothState;
using cloth_sim::ClothStats;
using dynamic_reconfigure::Config;

constexpr double rate = 50.0;

std::vector<std::string> small_sheet(const std::vector<std::string>& further = {})
{
  std::vector<std::string> arguments{ "_plan:=full", "_rate:=50", "_cloth/rows:=8", "_cloth/cols:=8",
                                      "_cloth/ripple:=0.02" };
  arguments.insert(arguments.end(), further.begin(), further.end());
  return arguments;
}

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

double stretch_of(const ClothState& state)
{
  double squares = 0.0;
  for (size_t i = 0; i < state.positions.size(); ++i)
  {
    squares += state.positions[i] * state.positions[i];
  }
  return squares;
}

class TuningTest : public testing::Test
{
protected:
  /// Ticks of equal length, and no state out of reach of the one before.
  void expect_no_jerk()
  {
    for (size_t i = 1; i < state_.all().size(); ++i)
    {
      const ClothState& before = state_.all()[i - 1];
      const ClothState& after = state_.all()[i];
      EXPECT_NEAR(after.sim_time - before.sim_time, 1.0 / rate, 1e-12);
      EXPECT_GT(after.step, before.step);
      EXPECT_LT(std::abs(stretch_of(after) - stretch_of(before)), 0.1 * stretch_of(before));
    }
  }

  Listener<ClothState> state_{ "/cloth_node/state" };
  Listener<ClothStats> stats_{ "/cloth_node/stats" };
};

/// A chain of four springs, at rest soon: the lowest node hangs M_i g / k below its place for each spring above it, M_i
/// the mass that the spring carries.
class Sag : public TuningTest
{
protected:
  static constexpr double node_mass = 0.04;  // kg
  static constexpr double top = 1.5;         // m

  static double lowest_at_rest(double stiffness, double gravity)
  {
    constexpr double carried = (1.0 + 2.0 + 3.0 + 4.0) * node_mass;
    return top - 1.0 - carried * gravity / stiffness;
  }

  bool wait_for_rest_at(double height)
  {
    return state_.wait_for_one([=](const ClothState& state) {
      float fastest = 0.0F;
      for (const float velocity : state.velocities)
      {
        fastest = std::max(fastest, std::abs(velocity));
      }
      return fastest < 1e-4F && std::abs(state.positions[3 * 4 + 2] - height) < 1e-4;
    });
  }

  // In full, so that it does not sleep a little beside its rest.
  NodeProcess node_{ { "_plan:=full", "_rate:=50", "_cloth/rows:=5", "_cloth/cols:=1", "_cloth/width:=0.02",
                       "_cloth/height:=1.0", "_cloth/mass:=0.2", "_cloth/mass_lumping:=uniform",
                       "_pins:=[{name: hook, nodes: [[0, 0]]}]", "_springs/structural/stiffness:=50",
                       "_springs/flex/stiffness:=0", "_strain_limit/max_strain:=0", "_air/viscous_damping:=120" } };
};

TEST_F(Sag, FollowsTheStiffnessThatDynparamSetsAsTheStaticsSay)
{
  ASSERT_TRUE(wait_for_rest_at(lowest_at_rest(50.0, 9.81)));
  ChildProcess dynparam(
      { "rosrun", "dynamic_reconfigure", "dynparam", "set", "/cloth_node", "springs_structural_stiffness", "200" });
  EXPECT_TRUE(wait_for_rest_at(lowest_at_rest(200.0, 9.81))) << dynparam.output();
  ASSERT_TRUE(wait_until([&] { return dynparam.exit_status().has_value(); }));
  EXPECT_EQ(*dynparam.exit_status(), 0) << dynparam.output();
  expect_no_jerk();
}

TEST_F(Sag, FollowsGravityToo)
{
  ASSERT_TRUE(wait_for_rest_at(lowest_at_rest(50.0, 9.81)));
  ASSERT_TRUE(Change().set("gravity_z", -2.0).ask());
  EXPECT_TRUE(wait_for_rest_at(lowest_at_rest(50.0, 2.0)));
}

TEST_F(TuningTest, OutOfRangeIsClampedAndAnswered)
{
  NodeProcess node(small_sheet());
  ASSERT_TRUE(state_.wait_for(1));
  Change change;
  ASSERT_TRUE(change.set("springs_structural_damping", -1.0).set("strain_limit_sweeps", 0).set("rate", 5000.0).ask());
  EXPECT_EQ(change.answered<double>("springs_structural_damping"), 0.0);
  EXPECT_EQ(change.answered<int>("strain_limit_sweeps"), 1);
  EXPECT_EQ(change.answered<double>("rate"), 1000.0);
  double written = -1.0;
  EXPECT_TRUE(ros::param::get("/cloth_node/springs/structural/damping", written));
  EXPECT_EQ(written, 0.0);
}

TEST_F(TuningTest, WhatIsNotFiniteIsRefusedAndAnsweredAsItWas)
{
  NodeProcess node(small_sheet());
  ASSERT_TRUE(state_.wait_for(1));
  Change change;
  ASSERT_TRUE(change.set("air_wind_y", std::numeric_limits<double>::quiet_NaN()).ask());
  EXPECT_EQ(change.answered<double>("air_wind_y"), 0.0);
  Change infinite;
  ASSERT_TRUE(infinite.set("springs_flex_stiffness", std::numeric_limits<double>::infinity()).ask());
  EXPECT_EQ(infinite.answered<double>("springs_flex_stiffness"), 10.0);
  EXPECT_TRUE(wait_until([&] { return contains(node.output(), "springs.flex.stiffness is .inf"); })) << node.output();
  EXPECT_TRUE(contains(node.output(), "air.wind is [0.0, .nan, 0.0]")) << node.output();
  ASSERT_TRUE(state_.wait_for_more(3));
  expect_no_jerk();
}

TEST_F(TuningTest, ARefusedCombinationKeepsTheRunningCloth)
{
  NodeProcess node(small_sheet());
  ASSERT_TRUE(state_.wait_for(3));
  ASSERT_TRUE(stats_.wait_for(1));
  const std::string planned = stats_.last().method;
  Change change;
  ASSERT_TRUE(change.set("solver_method", "explicit_euler").set("air_viscous_damping", 0.0).ask());
  EXPECT_EQ(change.answered<std::string>("solver_method"), "auto");
  EXPECT_EQ(change.answered<double>("air_viscous_damping"), 0.3);
  EXPECT_TRUE(stats_.wait_for_one([](const ClothStats& stats) {
    return contains(stats.plan, "tuning: refused: ") && contains(stats.plan, "take another method");
  }));
  EXPECT_EQ(stats_.last().method, planned);
  std::string written;
  EXPECT_FALSE(ros::param::get("/cloth_node/solver/method", written)) << written;
  ASSERT_TRUE(state_.wait_for_more(3));
  expect_no_jerk();

  ASSERT_TRUE(Change().set("solver_method", "rk4").ask());
  EXPECT_TRUE(stats_.wait_for_one([](const ClothStats& stats) {
    return stats.method == "rk4" && contains(stats.plan, "method: kept, rk4") && !contains(stats.plan, "tuning:");
  }));
}

TEST_F(TuningTest, TheStepFollowsTheNewLimit)
{
  NodeProcess node(small_sheet());
  ASSERT_TRUE(stats_.wait_for(1));
  const double before = stats_.last().time_step;
  ASSERT_TRUE(Change().set("springs_structural_stiffness", 3000.0).set("springs_shear_stiffness", 3000.0).ask());
  ASSERT_TRUE(stats_.wait_for_one([=](const ClothStats& stats) { return stats.time_step < 0.5 * before; }));
  ASSERT_TRUE(state_.wait_for_more(20));
  expect_no_jerk();
  EXPECT_FALSE(contains(node.output(), "diverged")) << node.output();
}

TEST_F(TuningTest, AGivenStepIsLoweredToTheNewLimitAndThatIsReported)
{
  NodeProcess node(small_sheet({ "_solver/time_step:=0.002" }));
  ASSERT_TRUE(state_.wait_for(3));
  Change change;
  ASSERT_TRUE(change.set("springs_structural_stiffness", 30000.0).ask());
  const double step = change.answered<double>("solver_time_step");
  EXPECT_GT(step, 0.0);
  EXPECT_LT(step, 0.001);
  double written = 0.0;
  EXPECT_TRUE(ros::param::get("/cloth_node/solver/time_step", written));
  EXPECT_EQ(written, step);
  EXPECT_TRUE(stats_.wait_for_one([=](const ClothStats& stats) {
    return stats.time_step <= step && contains(stats.plan, "tuning: solver.time_step lowered from 0.002 s to");
  }));
  EXPECT_TRUE(contains(node.output(), "solver.time_step lowered from 0.002 s")) << node.output();
  ASSERT_TRUE(state_.wait_for_more(10));
  expect_no_jerk();
  EXPECT_FALSE(contains(node.output(), "diverged")) << node.output();
}

TEST_F(TuningTest, PinsAndTheWindOfAMessageCarryOn)
{
  ros::NodeHandle test;
  const ros::Publisher pins = test.advertise<cloth_sim::Pin>("/cloth_node/pin", 10);
  const ros::Publisher winds = test.advertise<geometry_msgs::Vector3Stamped>("/cloth_node/wind", 10);
  NodeProcess node(small_sheet({ "_air/wind_coupling:=5" }));
  ASSERT_TRUE(wait_until([&] { return pins.getNumSubscribers() > 0 && winds.getNumSubscribers() > 0; }));
  pins.publish(pin_node("hand", 7, 0));
  geometry_msgs::Vector3Stamped wind;
  wind.vector.y = 8.0;
  winds.publish(wind);
  const auto blown = [](const ClothState& state) { return state.positions[3 * 60 + 1] > 0.2F; };
  const auto held = [](const ClothState& state) { return state.flags[56] == ClothState::PINNED; };
  ASSERT_TRUE(state_.wait_for_one([&](const ClothState& state) { return held(state) && blown(state); }));
  const std::vector<float> place(&state_.last().positions[3 * 56], &state_.last().positions[3 * 57]);
  ASSERT_TRUE(Change().set("springs_flex_stiffness", 12.0).ask());
  ASSERT_TRUE(state_.wait_for_more(50));
  EXPECT_TRUE(held(state_.last()));
  EXPECT_TRUE(blown(state_.last()));
  EXPECT_EQ(std::vector<float>(&state_.last().positions[3 * 56], &state_.last().positions[3 * 57]), place);
  expect_no_jerk();

  ASSERT_TRUE(Change().set("air_wind_y", -8.0).ask());
  EXPECT_TRUE(state_.wait_for_one([](const ClothState& state) { return state.positions[3 * 60 + 1] < -0.1F; }));
}

TEST_F(TuningTest, GustsBeginInStillAir)
{
  NodeProcess node(small_sheet({ "_air/wind_coupling:=5" }));
  ASSERT_TRUE(state_.wait_for(5));
  Change change;
  ASSERT_TRUE(change.set("air_gusts_strength", 20.0).set("air_gusts_time_scale", 0.0).set("air_gusts_seed", 7).ask());
  EXPECT_EQ(change.answered<double>("air_gusts_strength"), 20.0);
  EXPECT_EQ(change.answered<double>("air_gusts_time_scale"), 0.001);
  EXPECT_EQ(change.answered<int>("air_gusts_seed"), 7);
  ASSERT_TRUE(Change().set("air_gusts_time_scale", 1.0).ask());
  EXPECT_TRUE(
      state_.wait_for_one([](const ClothState& state) { return std::abs(state.positions[3 * 60 + 1]) > 0.2F; }));
}

TEST_F(TuningTest, SpringsOfNoStiffnessLeaveTheTopology)
{
  Listener<cloth_sim::ClothTopology> topology("/cloth_node/topology");
  NodeProcess node(small_sheet());
  ASSERT_TRUE(topology.wait_for(1));
  const size_t springs = topology.last().spring_kinds.size();
  ASSERT_TRUE(Change().set("springs_flex_stiffness", 0.0).ask());
  ASSERT_TRUE(topology.wait_for_one([](const auto& message) { return message.version == 2; }));
  EXPECT_LT(topology.last().spring_kinds.size(), springs);
  EXPECT_TRUE(state_.wait_for_one([](const ClothState& state) { return state.topology_version == 2; }));
  EXPECT_GT(state_.last().sim_time, 0.0);
}

TEST_F(TuningTest, RateAndRealTimeFactorGoOnFromWhereTheClothIs)
{
  NodeProcess node(small_sheet());
  ASSERT_TRUE(state_.wait_for(5));
  ASSERT_TRUE(Change().set("rate", 20.0).set("real_time_factor", 0.5).ask());
  ASSERT_TRUE(state_.wait_for_more(20));
  const auto& all = state_.all();
  double gap = 0.0;
  for (size_t i = 1; i < all.size(); ++i)
  {
    gap = all[i].sim_time - all[i - 1].sim_time;
    EXPECT_TRUE(std::abs(gap - 1.0 / rate) < 1e-12 || std::abs(gap - 0.5 / 20.0) < 1e-12) << gap;
  }
  EXPECT_NEAR(gap, 0.5 / 20.0, 1e-12);
  EXPECT_NEAR((all.back().header.stamp - all[all.size() - 2].header.stamp).toSec(), 1.0 / 20.0, 1e-8);
}

TEST_F(TuningTest, AfterAResetTheTunedValuesAreInForceAndShown)
{
  Listener<Config> updates("/cloth_node/parameter_updates");
  NodeProcess node(small_sheet());
  ASSERT_TRUE(state_.wait_for(3));
  ASSERT_TRUE(Change().set("springs_structural_stiffness", 150.0).ask());
  ASSERT_TRUE(trigger("reset").success);
  ASSERT_TRUE(state_.wait_for_one([](const ClothState& state) { return state.sim_time == 0.0; }));
  EXPECT_TRUE(stats_.wait_for_one(
      [](const ClothStats& stats) { return contains(stats.plan, "structural springs: kept, 112 of 150.0 N/m"); }));
  double shown = 0.0;
  dynamic_reconfigure::ConfigTools::getParameter(updates.last(), "springs_structural_stiffness", shown);
  EXPECT_EQ(shown, 150.0);
}

TEST_F(TuningTest, AReloadTakesTheScenesKeysAndShowsThem)
{
  Listener<Config> updates("/cloth_node/parameter_updates");
  NodeProcess node(small_sheet());
  ASSERT_TRUE(state_.wait_for(1));
  ASSERT_TRUE(Change().set("springs_shear_stiffness", 70.0).ask());
  ros::param::set("/cloth_node/springs/structural/stiffness", 130.0);
  ros::param::set("/cloth_node/springs_structural_stiffness", 999.0);
  const auto answer = trigger("reload");
  ASSERT_TRUE(answer.success) << answer.message;
  const auto shows = [](const Config& config, const std::string& name, double expected) {
    double value = 0.0;
    return dynamic_reconfigure::ConfigTools::getParameter(config, name, value) && value == expected;
  };
  EXPECT_TRUE(wait_until([&] {
    return !updates.all().empty() && shows(updates.last(), "springs_structural_stiffness", 130.0) &&
           shows(updates.last(), "springs_shear_stiffness", 70.0);
  }));
  EXPECT_TRUE(stats_.wait_for_one([](const ClothStats& stats) {
    return contains(stats.plan, "of 130.0 N/m") && contains(stats.plan, "of 70.0 N/m");
  }));

  ros::param::set("/cloth_node/cloth/rows", 0);
  EXPECT_FALSE(trigger("reload").success);
  state_.forget();
  ASSERT_TRUE(state_.wait_for(10));
  expect_no_jerk();
  Change nothing;
  ASSERT_TRUE(nothing.ask());
  EXPECT_EQ(nothing.answered<double>("springs_structural_stiffness"), 130.0);
}

TEST_F(TuningTest, AChangeOfTheDefaultSceneIsReloadedAsThatScene)
{
  Listener<cloth_sim::ClothTopology> topology("/cloth_node/topology");
  NodeProcess node({});
  ASSERT_TRUE(topology.wait_for(1));
  ASSERT_TRUE(state_.wait_for(1));
  ASSERT_TRUE(Change().set("springs_structural_stiffness", 120.0).ask());
  ASSERT_TRUE(trigger("reload").success);
  ASSERT_TRUE(state_.wait_for_one([](const ClothState& state) { return state.sim_time == 0.0; }));
  EXPECT_NE(state_.last().positions[3 * 500 + 1], 0.0F) << "the ripple of the hanging sheet";
}

TEST_F(TuningTest, FlatNamesThatAnEarlierNodeLeftCountForNothing)
{
  {
    NodeProcess node(small_sheet());
    ASSERT_TRUE(state_.wait_for(1));
    ASSERT_TRUE(Change().set("springs_structural_stiffness", 150.0).ask());
  }
  ros::param::del("/cloth_node/springs");
  stats_.forget();
  ChildProcess next({ CLOTH_NODE });
  EXPECT_TRUE(stats_.wait_for_one([](const ClothStats& stats) { return contains(stats.plan, "of 100.0 N/m"); }));
  Change nothing;
  ASSERT_TRUE(nothing.ask());
  EXPECT_EQ(nothing.answered<double>("springs_structural_stiffness"), 100.0);
}

}  // namespace
}  // namespace cloth
