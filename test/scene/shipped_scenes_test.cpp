#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "cloth_sim/forces/springs.h"
#include "cloth_sim/scene/parameter_table.h"
#include "cloth_sim/scene/plan.h"
#include "scene/scene_text.h"
#include "support.h"

namespace cloth
{
namespace
{

std::string path_of(const std::string& scene)
{
  return "config/" + scene + ".yaml";
}

TEST(ShippedScenes, AreTheFilesInConfig)
{
  std::set<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator("config"))
  {
    if (entry.path().extension() == ".yaml")
    {
      found.insert(entry.path().stem());
    }
  }
  EXPECT_EQ(found, std::set<std::string>(shipped_scenes.begin(), shipped_scenes.end()));
}

class ShippedScene : public testing::TestWithParam<std::string>
{
};

INSTANTIATE_TEST_SUITE_P(Each, ShippedScene, testing::ValuesIn(shipped_scenes),
                         [](const testing::TestParamInfo<std::string>& info) { return info.param; });

TEST_P(ShippedScene, SaysItsPurposeOnTheFirstLine)
{
  std::ifstream file(path_of(GetParam()));
  std::string line;
  ASSERT_TRUE(std::getline(file, line));
  EXPECT_EQ(line.substr(0, 2), "# ");
  EXPECT_GT(line.size(), 30u);
  EXPECT_EQ(line.back(), '.');
}

TEST_P(ShippedScene, IsComplete)
{
  const YAML::Node tree = load_scene_file(path_of(GetParam()));
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    EXPECT_EQ(value_at(tree, parameter.key).IsDefined(), !parameter.node_only) << parameter.key;
  }
  EXPECT_TRUE(tree["pins"].IsDefined());
  EXPECT_EQ(faults_of(tree), "");
}

TEST_P(ShippedScene, RunsWithAStepOfItsOwnAndStaysSane)
{
  SceneParams scene = shipped_scene(GetParam());
  scene.solver.method = "velocity_verlet";
  Simulation simulation = build_simulation(make_plan(scene));
  EXPECT_EQ(time_step_warning(simulation), "");
  EXPECT_TRUE(simulation.advance_to(0.2)) << simulation.divergence_report();
  EXPECT_TRUE(simulation.state().positions.allFinite());
  EXPECT_LT(max_strain(simulation.model(), simulation.state().positions), 0.5);
  EXPECT_LT(simulation.state().velocities.rowwise().norm().maxCoeff(), 20.0);
  EXPECT_GT(simulation.state().velocities.rowwise().norm().maxCoeff(), 0.0);
  EXPECT_LT(simulation.counters().steps, 1000u);
}

TEST(HangingSheet, IsHeldByTwoCornersDrawnTogetherAndRippled)
{
  const SceneParams scene = shipped_scene("hanging_sheet");
  EXPECT_EQ(scene.start.initial_stretch, Eigen::Vector2d(0.9, 1.0));
  EXPECT_EQ(scene.start.ripple, 0.02);
  EXPECT_EQ(scene.strain_limit.max_strain, 0.1);
  EXPECT_EQ(scene.strain_limit.sweeps, 30);
  const Simulation simulation = build_simulation(make_plan(scene));
  std::vector<int> held;
  for (const Pin& pin : simulation.pins().all())
  {
    held.insert(held.end(), pin.nodes.begin(), pin.nodes.end());
  }
  EXPECT_EQ(held, (std::vector<int>{ 0, scene.sheet.cols - 1 }));
  EXPECT_NEAR(simulation.state().positions(scene.sheet.cols - 1, 0) - simulation.state().positions(0, 0), 0.9, 1e-15);
}

TEST(HangingSheet, IsOtherwiseTheDefaultScene)
{
  const SceneParams scene = shipped_scene("hanging_sheet");
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    if (parameter.key != "cloth.initial_stretch" && parameter.key != "cloth.ripple")
    {
      EXPECT_EQ(parameter.get(scene), parameter.get(SceneParams())) << parameter.key;
    }
  }
}

}  // namespace
}  // namespace cloth
