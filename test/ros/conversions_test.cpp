#include "conversions.h"

#include <ctime>

#include <gtest/gtest.h>

#include "cloth_sim/scene/scene_reader.h"

#include "support.h"

namespace cloth
{
namespace
{

TEST(ToYaml, ReadsBackAsTheScene)
{
  XmlRpc::XmlRpcValue tree;
  tree["cloth"]["rows"] = 7;
  tree["cloth"]["mass"] = 0.1 + 0.2;
  tree["gravity"] = std::string("[0,0,-1]");
  tree["solver"]["time_step"] = std::string("1e-3");
  tree["pins"][0]["name"] = std::string("a");
  tree["pins"][0]["nodes"][0][0] = 0;
  tree["pins"][0]["nodes"][0][1] = -1;
  tree["start_paused"] = false;
  const SceneParams scene = read_scene(to_yaml(tree));
  EXPECT_EQ(scene.sheet.rows, 7);
  EXPECT_EQ(scene.sheet.mass, 0.1 + 0.2);
  EXPECT_EQ(scene.gravity, Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(scene.solver.time_step, 1e-3);
  ASSERT_EQ(scene.pins.size(), 1u);
  EXPECT_EQ(scene.pins[0].nodes[0][1], -1);
}

TEST(ToYaml, NothingSetIsAnEmptyScene)
{
  EXPECT_EQ(read_scene(to_yaml(XmlRpc::XmlRpcValue())).sheet.rows, SceneParams().sheet.rows);
}

TEST(ToYaml, AnEmptyListStaysOne)
{
  XmlRpc::XmlRpcValue tree;
  tree["pins"].setSize(0);
  EXPECT_TRUE(read_scene(to_yaml(tree)).pins.empty());
}

TEST(ToYaml, DatesAndBinaryDataAreRefusedByTheReader)
{
  char bytes[] = "1.0";
  XmlRpc::XmlRpcValue tree;
  tree["cloth"]["mass"] = XmlRpc::XmlRpcValue(bytes, 3);
  EXPECT_THROW(read_scene(to_yaml(tree)), SceneError);
  std::tm date{};
  tree["cloth"]["mass"] = XmlRpc::XmlRpcValue(&date);
  EXPECT_THROW(read_scene(to_yaml(tree)), SceneError);
}

TEST(ToFloat32, PutsXYZOfEachNodeInTurn)
{
  Vectors rows(2, 3);
  rows << 1, 2, 3, 4, 5, 6;
  std::vector<float> values;
  to_float32(rows, values);
  EXPECT_EQ(values, (std::vector<float>{ 1, 2, 3, 4, 5, 6 }));
}

TEST(ToPoint, IsARow)
{
  Vectors rows(2, 3);
  rows << 1, 2, 3, 4, 5, 6;
  EXPECT_EQ(to_eigen(to_point(rows, 1)), Eigen::Vector3d(4, 5, 6));
}

TEST(ToParameter, GivesEachValueItsType)
{
  const XmlRpc::XmlRpcValue parameter =
      to_parameter(YAML::Load("{a: 3, b: 0.25, c: word, d: [1.0e-05, -2], e: {f: true}}"));
  const auto at = [&](const char* name) { return const_cast<XmlRpc::XmlRpcValue&>(parameter)[name]; };
  EXPECT_EQ(static_cast<int>(at("a")), 3);
  EXPECT_EQ(static_cast<double>(at("b")), 0.25);
  EXPECT_EQ(static_cast<std::string>(at("c")), "word");
  EXPECT_EQ(static_cast<double>(at("d")[0]), 1e-5);
  EXPECT_EQ(static_cast<int>(at("d")[1]), -2);
  EXPECT_TRUE(static_cast<bool>(at("e")["f"]));
}

TEST(ToParameter, AnEmptyListStaysAList)
{
  EXPECT_EQ(to_parameter(YAML::Load("[]")).getType(), XmlRpc::XmlRpcValue::TypeArray);
}

}  // namespace
}  // namespace cloth
