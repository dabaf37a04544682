#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothStats.h"
#include "cloth_sim/ClothTopology.h"

#include "listener.h"

namespace cloth
{
namespace
{

constexpr int rows = 8;
constexpr int cols = 6;
constexpr double rate = 50.0;

using visualization_msgs::Marker;

bool is_finite(const geometry_msgs::Point& point)
{
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

TEST(Mesh, IsAMarkerThatRvizDraws)
{
  Listener<Marker> mesh("/cloth_node/mesh");
  ASSERT_TRUE(mesh.wait_for(1));
  const Marker& marker = mesh.last();
  EXPECT_TRUE(mesh.latched());
  EXPECT_EQ(marker.type, Marker::TRIANGLE_LIST);
  EXPECT_EQ(marker.action, Marker::ADD);
  EXPECT_EQ(marker.header.frame_id, "world");
  EXPECT_EQ(marker.pose.orientation.w, 1.0);
  EXPECT_EQ(marker.scale.x * marker.scale.y * marker.scale.z, 1.0);
  EXPECT_EQ(marker.color.a, 1.0F);
  EXPECT_EQ(marker.points.size(), 3u * 2u * (rows - 1) * (cols - 1));
  EXPECT_TRUE(std::all_of(marker.points.begin(), marker.points.end(), is_finite));
}

TEST(Mesh, IsLitAtEveryVertex)
{
  Listener<Marker> mesh("/cloth_node/mesh");
  ASSERT_TRUE(mesh.wait_for(1));
  ASSERT_EQ(mesh.last().colors.size(), mesh.last().points.size());
  for (const auto& colour : mesh.last().colors)
  {
    EXPECT_EQ(colour.a, 1.0F);
    EXPECT_GT(colour.r, 0.15F);  // of a fabric whose red is 0.75
  }
}

TEST(Mesh, IsTheSameMarkerAllTheTime)
{
  Listener<Marker> mesh("/cloth_node/mesh");
  ASSERT_TRUE(mesh.wait_for(20));
  for (const Marker& marker : mesh.all())
  {
    EXPECT_EQ(marker.ns, mesh.last().ns);
    EXPECT_EQ(marker.id, mesh.last().id);
    EXPECT_EQ(marker.points.size(), mesh.last().points.size());
  }
}

TEST(Mesh, ShowsTheStateOfTheSameTick)
{
  Listener<Marker> mesh("/cloth_node/mesh");
  Listener<cloth_sim::ClothState> state("/cloth_node/state");
  Listener<cloth_sim::ClothTopology> topology("/cloth_node/topology");
  ASSERT_TRUE(topology.wait_for(1));
  ASSERT_TRUE(wait_until([&] {
    return !mesh.all().empty() && !state.all().empty() && mesh.last().header.stamp == state.last().header.stamp;
  }));
  const auto& triangles = topology.last().triangles;
  ASSERT_EQ(mesh.last().points.size(), triangles.size());
  for (size_t corner = 0; corner < triangles.size(); ++corner)
  {
    const float* const position = &state.last().positions[3 * triangles[corner]];
    EXPECT_EQ(static_cast<float>(mesh.last().points[corner].x), position[0]);
    EXPECT_EQ(static_cast<float>(mesh.last().points[corner].y), position[1]);
    EXPECT_EQ(static_cast<float>(mesh.last().points[corner].z), position[2]);
  }
}

TEST(State, ComesOncePerTickOfSimulatedTime)
{
  Listener<cloth_sim::ClothState> state("/cloth_node/state");
  ASSERT_TRUE(state.wait_for(30));
  for (size_t i = 1; i < state.all().size(); ++i)
  {
    const auto& before = state.all()[i - 1];
    const auto& now = state.all()[i];
    EXPECT_NEAR(now.sim_time - before.sim_time, 1.0 / rate, 1e-12);
    EXPECT_GT(now.header.stamp, before.header.stamp);
    EXPECT_GT(now.step, before.step);
  }
}

TEST(State, HasAllNodesAndTheirPins)
{
  Listener<cloth_sim::ClothState> state("/cloth_node/state");
  ASSERT_TRUE(state.wait_for(1));
  const auto& message = state.last();
  EXPECT_EQ(message.header.frame_id, "world");
  ASSERT_EQ(message.positions.size(), 3u * rows * cols);
  ASSERT_EQ(message.velocities.size(), 3u * rows * cols);
  ASSERT_EQ(message.flags.size(), 1u * rows * cols);
  for (size_t node = 0; node < message.flags.size(); ++node)
  {
    const bool upper_corner = node == 0 || node == cols - 1;
    EXPECT_EQ(message.flags[node], upper_corner ? cloth_sim::ClothState::PINNED : 0) << "node " << node;
  }
}

TEST(Topology, FitsTheState)
{
  Listener<cloth_sim::ClothTopology> topology("/cloth_node/topology");
  Listener<cloth_sim::ClothState> state("/cloth_node/state");
  ASSERT_TRUE(topology.wait_for(1));
  ASSERT_TRUE(state.wait_for(1));
  const auto& message = topology.last();
  EXPECT_TRUE(topology.latched());
  EXPECT_EQ(message.version, state.last().topology_version);
  EXPECT_EQ(message.rows, static_cast<std::uint32_t>(rows));
  EXPECT_EQ(message.cols, static_cast<std::uint32_t>(cols));
  EXPECT_EQ(message.rest_positions.size(), state.last().positions.size());
  EXPECT_EQ(message.masses.size(), state.last().flags.size());
}

TEST(Springs, ComeToThoseWhoListen)
{
  Listener<Marker> springs("/cloth_node/springs");
  Listener<cloth_sim::ClothTopology> topology("/cloth_node/topology");
  ASSERT_TRUE(springs.wait_for(2));
  ASSERT_TRUE(topology.wait_for(1));
  const Marker& marker = springs.last();
  EXPECT_EQ(marker.type, Marker::LINE_LIST);
  EXPECT_EQ(marker.points.size(), topology.last().spring_nodes.size());
  EXPECT_EQ(marker.colors.size(), marker.points.size());
  EXPECT_TRUE(std::all_of(marker.points.begin(), marker.points.end(), is_finite));
}

TEST(Pins, AreShownToThoseWhoComeLate)
{
  Listener<visualization_msgs::MarkerArray> pins("/cloth_node/pins");
  ASSERT_TRUE(pins.wait_for(1));
  EXPECT_TRUE(pins.latched());
  ASSERT_EQ(pins.last().markers.size(), 2u);
  EXPECT_EQ(pins.last().markers[0].ns, "left");
  EXPECT_EQ(pins.last().markers[1].ns, "right");
  EXPECT_EQ(pins.last().markers[0].type, Marker::SPHERE_LIST);
  EXPECT_EQ(pins.last().markers[0].points.size(), 1u);
}

TEST(Stats, SayHowTheSimulationFares)
{
  Listener<cloth_sim::ClothStats> stats("/cloth_node/stats");
  ASSERT_TRUE(stats.wait_for(2));
  const auto& before = stats.all()[0];
  const auto& now = stats.all()[1];
  EXPECT_GT(now.step, before.step);
  EXPECT_GT(now.sim_time, before.sim_time);
  EXPECT_GT(now.real_time_factor, 0.0);
  EXPECT_GT(now.tick_ms_mean, 0.0);
  EXPECT_GE(now.tick_ms_max, now.tick_ms_mean);
  EXPECT_GT(now.gravitational_energy, 0.0);
  EXPECT_GT(now.elastic_energy, 0.0);
  EXPECT_GT(now.max_strain, 0.0);
  EXPECT_LT(now.max_strain, 0.11);
  EXPECT_GT(now.time_step, 0.0);
  EXPECT_NE(now.plan.find("method: kept, " + now.method), std::string::npos) << now.plan;
  EXPECT_FALSE(now.paused);
  EXPECT_NE(now.plan.find("gravity"), std::string::npos);
  EXPECT_NE(now.plan.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace cloth
