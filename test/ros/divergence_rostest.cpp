#include <cmath>

#include <gtest/gtest.h>
#include <visualization_msgs/Marker.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothStats.h"

#include "child_process.h"
#include "listener.h"

namespace cloth
{
namespace
{

bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

TEST(Divergence, KeepsTheLastGoodClothOnShow)
{
  ChildProcess node({ CLOTH_NODE, "_rate:=50", "_cloth/rows:=8", "_cloth/cols:=8", "_cloth/ripple:=0.02",
                      "_solver/time_step:=0.02", "_solver/method:=symplectic_euler", "_strain_limit/max_strain:=0",
                      "_springs/structural/stiffness:=5000" });
  ASSERT_TRUE(wait_until([&] { return contains(node.output(), "diverged at"); })) << node.output();
  EXPECT_TRUE(contains(node.output(), "solver.time_step is 0.02 s, beyond the stability limit of symplectic_euler"));

  Listener<cloth_sim::ClothState> state("/cloth_node/state");
  Listener<visualization_msgs::Marker> mesh("/cloth_node/mesh");
  Listener<cloth_sim::ClothStats> stats("/cloth_node/stats");
  ASSERT_TRUE(state.wait_for(20));
  ASSERT_TRUE(mesh.wait_for(20));
  ASSERT_TRUE(stats.wait_for(1));
  EXPECT_GT(state.all()[19].header.stamp, state.all()[0].header.stamp);
  EXPECT_EQ(state.all()[19].sim_time, state.all()[0].sim_time);
  EXPECT_EQ(state.all()[19].positions, state.all()[0].positions);
  for (const auto& point : mesh.last().points)
  {
    EXPECT_TRUE(std::isfinite(point.x) && std::abs(point.x) < 100.0);
  }

  const std::string output = node.output();
  EXPECT_EQ(output.find("diverged at"), output.rfind("diverged at")) << "reported more than once:\n" << output;
  EXPECT_FALSE(node.exit_status().has_value());
}

}  // namespace
}  // namespace cloth
