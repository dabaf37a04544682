#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <ros/param.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothStats.h"
#include "cloth_sim/ClothTopology.h"

#include "listener.h"
#include "node_process.h"
#include "time_services.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothState;
using cloth_sim::ClothStats;
using cloth_sim::ClothTopology;
using visualization_msgs::Marker;

constexpr double rate = 50.0;

/// A running node of 8 x 6 nodes.
class Reload : public testing::Test
{
protected:
  void SetUp() override
  {
    ASSERT_TRUE(topology_.wait_for(1));
    ASSERT_TRUE(state_.wait_for(3));
  }

  void expect_refused(const std::vector<std::string>& named)
  {
    const auto answer = trigger("reload");
    EXPECT_FALSE(answer.success);
    for (const std::string& word : named)
    {
      EXPECT_NE(answer.message.find(word), std::string::npos) << word << " is not in: " << answer.message;
    }
    ASSERT_TRUE(state_.wait_for_more(10));
    for (size_t i = 1; i < state_.all().size(); ++i)
    {
      EXPECT_NEAR(state_.all()[i].sim_time - state_.all()[i - 1].sim_time, 1.0 / rate, 1e-12);
      EXPECT_EQ(state_.all()[i].topology_version, 1u);
    }
    EXPECT_EQ(topology_.last().version, 1u);
  }

  Listener<ClothTopology> topology_{ "/cloth_node/topology" };
  Listener<ClothState> state_{ "/cloth_node/state" };
  Listener<ClothStats> stats_{ "/cloth_node/stats" };
  Listener<Marker> mesh_{ "/cloth_node/mesh" };
  Listener<visualization_msgs::MarkerArray> pins_{ "/cloth_node/pins" };
  NodeProcess node_{ { "_rate:=50", "_cloth/rows:=8", "_cloth/cols:=6" } };
};

TEST_F(Reload, ABadSceneIsRefusedAndTheClothGoesOn)
{
  ros::param::set("/cloth_node/cloth/rows", 0);
  ros::param::set("/cloth_node/solver/metod", "rk4");
  expect_refused({ "cloth.rows", "0", "an integer from 1 to 4096", "solver.metod", "not a key" });
}

TEST_F(Reload, ASceneWhosePartsDoNotFitIsRefused)
{
  ros::param::set("/cloth_node/solver/compliance", 0.5);
  expect_refused({ "solver.compliance", "0.5", "1 is allowed" });
}

TEST_F(Reload, TheClockModeStays)
{
  ros::param::set("/cloth_node/clock_mode", "master");
  expect_refused({ "clock_mode", "master", "allowed: follow" });
}

TEST_F(Reload, AnotherGridIsAnotherTopology)
{
  ros::param::set("/cloth_node/cloth/rows", 5);
  const auto answer = trigger("reload");
  ASSERT_TRUE(answer.success) << answer.message;
  ASSERT_TRUE(state_.wait_for_one([](const ClothState& state) { return state.topology_version == 2; }));
  EXPECT_EQ(state_.last().sim_time, 0.0);
  EXPECT_EQ(state_.last().step, 0u);
  EXPECT_EQ(state_.last().positions.size(), 3u * 5u * 6u);
  EXPECT_TRUE(wait_until([&] { return topology_.last().version == 2; }));
  EXPECT_EQ(topology_.last().rows, 5u);
  EXPECT_TRUE(mesh_.wait_for_one([](const Marker& mesh) { return mesh.points.size() == 3u * 2u * 4u * 5u; }));
  EXPECT_TRUE(stats_.wait_for_one([](const ClothStats& stats) { return stats.sim_time > 0.0; }));
  EXPECT_GT(stats_.last().real_time_factor, 0.0);

  Listener<ClothTopology> late("/cloth_node/topology");
  ASSERT_TRUE(late.wait_for(1));
  EXPECT_EQ(late.last().version, 2u);
}

TEST_F(Reload, TheSameSheetKeepsItsTopology)
{
  ros::param::set("/cloth_node/air/viscous_damping", 0.5);
  ros::param::set("/cloth_node/cloth/ripple", 0.01);
  ASSERT_TRUE(trigger("reload").success);
  ASSERT_TRUE(state_.wait_for_one([](const ClothState& state) { return state.sim_time == 0.0; }));
  EXPECT_EQ(state_.last().topology_version, 1u);
  ASSERT_TRUE(state_.wait_for_more(5));
  EXPECT_EQ(topology_.last().version, 1u);
}

TEST_F(Reload, KeysOfTheNodeChangeToo)
{
  ros::param::set("/cloth_node/frame_id", "stage");
  ros::param::set("/cloth_node/rate", 20);
  ros::param::set("/cloth_node/real_time_factor", 2);
  ros::param::set("/cloth_node/display/fabric_colour", std::vector<double>{ 0.0, 0.0, 1.0 });
  ASSERT_TRUE(trigger("reload").success);
  const auto in_new_frame = [](const auto& message) { return message.header.frame_id == "stage"; };
  ASSERT_TRUE(state_.wait_for_one(in_new_frame));
  EXPECT_TRUE(state_.wait_for_one([](const ClothState& state) { return std::abs(state.sim_time - 0.1) < 1e-12; }));
  EXPECT_TRUE(mesh_.wait_for_one(in_new_frame));
  EXPECT_EQ(mesh_.last().color.b, 1.0F);
  EXPECT_TRUE(wait_until([&] { return in_new_frame(topology_.last()); }));
  EXPECT_TRUE(stats_.wait_for_one(in_new_frame));
}

TEST_F(Reload, MarkersOfPinsThatAreGoneAreDeleted)
{
  ASSERT_TRUE(pins_.wait_for(1));
  ros::param::set("/cloth_node/frame_id", "stage");
  XmlRpc::XmlRpcValue none;
  none.setSize(0);
  ros::param::set("/cloth_node/pins", none);
  ASSERT_TRUE(trigger("reload").success);
  const auto deletes_both = [](const visualization_msgs::MarkerArray& array) {
    return array.markers.size() == 2 && array.markers[0].action == Marker::DELETE &&
           array.markers[1].action == Marker::DELETE;
  };
  EXPECT_TRUE(wait_until([&] { return std::any_of(pins_.all().begin(), pins_.all().end(), deletes_both); }));
  EXPECT_TRUE(wait_until([&] { return pins_.last().markers.empty(); }));
}

}  // namespace
}  // namespace cloth
