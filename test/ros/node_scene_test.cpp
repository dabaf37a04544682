#include "node_scene.h"

#include <set>

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

TEST(DescribesACloth, NotWithKeysOfTheNodeAlone)
{
  EXPECT_FALSE(describes_a_cloth(YAML::Node()));
  EXPECT_FALSE(describes_a_cloth(YAML::Load("{rate: 10, display: {colouring: strain}}")));
  EXPECT_TRUE(describes_a_cloth(YAML::Load("{rate: 10, gravity: [0, 0, -1]}")));
  EXPECT_TRUE(describes_a_cloth(YAML::Load("{rate: 10, grvity: [0, 0, -1]}"))) << "a misspelt key is for the reader";
  EXPECT_TRUE(describes_a_cloth(YAML::Load("5")));
}

TEST(WithoutNamesOfTools, LeavesTheScenesKeysAndWhatNobodyKnows)
{
  const YAML::Node rest = without_names_of_tools(YAML::Load(
      "{gravity: [0, 0, -1], gravity_x: 1, springs: {flex: {damping: 1}}, springs_flex_damping: 2, rate: 10, "
      "solver_method: rk4, air_wind_z: 3, air_wind_w: 4, cloth_rows: 5, diagnostic_period: 1}"));
  std::set<std::string> names;
  for (const auto& entry : rest)
  {
    names.insert(entry.first.as<std::string>());
  }
  EXPECT_EQ(names, (std::set<std::string>{ "gravity", "springs", "rate", "air_wind_w", "cloth_rows" }));
  EXPECT_EQ(without_names_of_tools(YAML::Load("5")).as<int>(), 5) << "a scene that is no map is for the reader";
}

TEST(LaidOver, TakesTheUpperValueKeyByKey)
{
  const YAML::Node base = YAML::Load("{rate: 10, display: {colouring: fabric, fabric_colour: [1, 0, 0]}}");
  const YAML::Node merged = laid_over(base, YAML::Load("{display: {colouring: strain}, real_time_factor: 2}"));
  EXPECT_EQ(merged["rate"].as<int>(), 10);
  EXPECT_EQ(merged["real_time_factor"].as<int>(), 2);
  EXPECT_EQ(merged["display"]["colouring"].as<std::string>(), "strain");
  EXPECT_EQ(merged["display"]["fabric_colour"][0].as<int>(), 1);
  EXPECT_EQ(base["display"]["colouring"].as<std::string>(), "fabric");
}

TEST(LaidOver, NothingChangesNothing)
{
  EXPECT_EQ(laid_over(YAML::Load("{rate: 10}"), YAML::Node())["rate"].as<int>(), 10);
}

}  // namespace
}  // namespace cloth
