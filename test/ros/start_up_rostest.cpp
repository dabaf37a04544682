#include <algorithm>
#include <csignal>
#include <ostream>

#include <gtest/gtest.h>
#include <visualization_msgs/Marker.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothTopology.h"

#include "listener.h"
#include "node_process.h"

namespace cloth
{
namespace
{

struct BadParameter
{
  std::vector<std::string> arguments;
  std::vector<std::string> named;  ///< what the node must say: key, value, what is allowed
};

void PrintTo(const BadParameter& bad, std::ostream* stream)
{
  *stream << bad.arguments.front();
}

class BadParameters : public testing::TestWithParam<BadParameter>
{
};

TEST_P(BadParameters, AreNamedAndEndTheNode)
{
  Listener<visualization_msgs::Marker> mesh("/cloth_node/mesh");
  NodeProcess node(GetParam().arguments);
  ASSERT_TRUE(node.wait_for_end());
  EXPECT_EQ(node.exit_status(), 1);
  EXPECT_TRUE(mesh.all().empty());
  for (const std::string& word : GetParam().named)
  {
    EXPECT_NE(node.output().find(word), std::string::npos) << word << " is not in\n" << node.output();
  }
}

INSTANTIATE_TEST_SUITE_P(
    EachKind, BadParameters,
    testing::Values(BadParameter{ { "_grvity:=[0,0,-1]" }, { "grvity", "not a key", "gravity" } },
                    BadParameter{ { "_cloth/rows:=many" }, { "cloth.rows", "many", "an integer from 1" } },
                    BadParameter{ { "_cloth/mass:=-0.1" }, { "cloth.mass", "-0.1", "> 0.0" } },
                    BadParameter{ { "_gravity:=[0,0,.nan]" }, { "gravity", ".nan", "3 finite numbers" } },
                    BadParameter{ { "_rate:=0" }, { "rate", "0", ">= 0.001" } },
                    BadParameter{ { "_clock_mode:=master" }, { "clock_mode", "master", "/use_sim_time", "follow" } },
                    BadParameter{ { "_cloth/rows:=0", "_solver/metod:=rk4" }, { "cloth.rows", "solver.metod" } }));

TEST(StartUp, WithoutParametersTheHangingSheetIsShown)
{
  Listener<cloth_sim::ClothTopology> topology("/cloth_node/topology");
  Listener<cloth_sim::ClothState> state("/cloth_node/state");
  NodeProcess node({});
  ASSERT_TRUE(topology.wait_for(1));
  EXPECT_EQ(topology.last().rows, 32u);
  // Its ripple tells it from the flat sheet of an empty scene.
  ASSERT_TRUE(state.wait_for(1));
  EXPECT_NE(state.last().positions[3 * 500 + 1], 0.0F);
  node.signal(SIGINT);
  ASSERT_TRUE(node.wait_for_end());
  EXPECT_EQ(node.exit_status(), 0);
}

TEST(StartUp, KeysOfTheNodeAreLaidOverTheHangingSheet)
{
  Listener<cloth_sim::ClothState> state("/cloth_node/state");
  NodeProcess node({ "_rate:=10" });
  ASSERT_TRUE(state.wait_for(4));
  EXPECT_NE(state.last().positions[3 * 500 + 1], 0.0F);
  EXPECT_NEAR(state.all()[3].sim_time - state.all()[2].sim_time, 0.1, 1e-12);
}

TEST(StartUp, TextOfTheCommandLineIsTakenAsNumbers)
{
  Listener<cloth_sim::ClothTopology> topology("/cloth_node/topology");
  NodeProcess node({ "_cloth/rows:=20", "_cloth/cols:=5", "_gravity:=[0,0,-1]", "_solver/method:=velocity_verlet",
                     "_solver/time_step:=1e-3" });
  ASSERT_TRUE(topology.wait_for(1));
  EXPECT_EQ(topology.last().rows, 20u);
  node.signal(SIGINT);
  ASSERT_TRUE(node.wait_for_end());
  EXPECT_NE(node.output().find("1.0 m/s2"), std::string::npos) << node.output();
  EXPECT_NE(node.output().find("0.001 s"), std::string::npos) << node.output();
}

TEST(StartUp, AChainIsDrawnAsARibbon)
{
  Listener<visualization_msgs::Marker> mesh("/cloth_node/mesh");
  NodeProcess node(
      { "_cloth/rows:=5", "_cloth/cols:=1", "_cloth/width:=0.02", "_pins:=[{name: top, nodes: [[0, 0]]}]" });
  ASSERT_TRUE(mesh.wait_for(1));
  EXPECT_EQ(mesh.last().points.size(), 3u * 2u * 4u);
}

TEST(StartUp, StrainColoursTellStretchedFromSlack)
{
  Listener<visualization_msgs::Marker> mesh("/cloth_node/mesh");
  NodeProcess node({ "_display/colouring:=strain" });
  const auto most_red = [](const visualization_msgs::Marker& marker) {
    float most = -1.0F;
    for (const auto& colour : marker.colors)
    {
      most = std::max(most, colour.r - colour.b);
    }
    return most;
  };
  const auto most_blue = [](const visualization_msgs::Marker& marker) {
    float most = -1.0F;
    for (const auto& colour : marker.colors)
    {
      most = std::max(most, colour.b - colour.r);
    }
    return most;
  };
  EXPECT_TRUE(mesh.wait_for_one(
      [&](const visualization_msgs::Marker& marker) { return most_red(marker) > 0.3F && most_blue(marker) > 0.2F; }));
}

class EndBy : public testing::TestWithParam<int>
{
};

TEST_P(EndBy, ASignalIsNoFailure)
{
  Listener<cloth_sim::ClothState> state("/cloth_node/state");
  NodeProcess node({ "_rate:=50", "_cloth/rows:=8" });
  ASSERT_TRUE(state.wait_for(1));
  node.signal(GetParam());
  ASSERT_TRUE(node.wait_for_end());
  EXPECT_EQ(node.exit_status(), 0);
}

INSTANTIATE_TEST_SUITE_P(Signals, EndBy, testing::Values(SIGINT, SIGTERM));

}  // namespace
}  // namespace cloth
