// The scenes of plan_matrix: the same on any machine, in the ranges that are asked for, and such that motions can be
// compared.

#include <algorithm>
#include <cmath>
#include <set>

#include "cloth_sim/scene/plan.h"
#include "draw.h"
#include "drawn_scene.h"
#include "part.h"
#include "scene/scene_text.h"

namespace cloth
{
namespace
{

constexpr int many = 400;

std::vector<SceneParams> many_scenes()
{
  std::vector<SceneParams> scenes;
  for (int number = 0; number < many; ++number)
  {
    scenes.push_back(drawn_scene({ 1, number, 0, 96 }));
  }
  return scenes;
}

template <typename Predicate>
double share_of(const std::vector<SceneParams>& scenes, Predicate&& has)
{
  return static_cast<double>(std::count_if(scenes.begin(), scenes.end(), has)) / static_cast<double>(scenes.size());
}

double area_density(const SceneParams& scene)
{
  return scene.sheet.mass / (scene.sheet.width * scene.sheet.height);
}

bool has_moving_pin(const SceneParams& scene)
{
  return std::any_of(scene.pins.begin(), scene.pins.end(),
                     [](const PinParams& pin) { return !pin.motion.amplitude.isZero(0.0); });
}

/// From an implementation of the engine and of splitmix64 in another language.
TEST(Draw, GivesTheSameNumbersOnAnyMachine)
{
  Draw first(1, 0, 0);
  EXPECT_EQ(std::ldexp(first.part(), 53), 6596539106966990.0);
  EXPECT_EQ(std::ldexp(first.part(), 53), 3620565384767884.0);
  EXPECT_EQ(std::ldexp(first.part(), 53), 1804554207086150.0);
  EXPECT_EQ(std::ldexp(first.part(), 53), 1379421798441872.0);
  Draw other(7, 12, 3);
  EXPECT_EQ(std::ldexp(other.part(), 53), 8836416223243961.0);
  EXPECT_EQ(std::ldexp(other.part(), 53), 1269024929871238.0);
}

TEST(Draw, MapsPartsToNumbersOfThreeDigits)
{
  // 6596539106966990 / 2^53 = 0.73236...
  EXPECT_EQ(Draw(1, 0, 0).even(0.0, 1.0), 0.732);
  EXPECT_EQ(Draw(1, 0, 0).even(-1.0, 1.0), 0.465);
  EXPECT_EQ(Draw(1, 0, 0).logarithmic(1e2, 1e5), 15700.0);
  EXPECT_EQ(Draw(1, 0, 0).whole(0, 3), 2);
  EXPECT_TRUE(Draw(1, 0, 0).once_in(3, 4));
  EXPECT_FALSE(Draw(1, 0, 0).once_in(2, 4));
}

TEST(Draw, ReachesBothEndsOfARange)
{
  std::set<int> seen;
  Draw draw(1, 0, 0);
  for (int i = 0; i < many; ++i)
  {
    seen.insert(draw.whole(-2, 2));
  }
  EXPECT_EQ(seen, std::set<int>({ -2, -1, 0, 1, 2 }));
}

TEST(DrawnScene, IsTheSceneThatItWasWhenItWasFirstDrawn)
{
  const SceneParams scene = drawn_scene({ 1, 2, 0, 96 });
  const SceneParams again = drawn_scene({ 1, 2, 0, 96 });
  EXPECT_EQ(yaml_of(scene), yaml_of(again));
  EXPECT_EQ(scene.sheet.rows, 9);
  EXPECT_EQ(scene.sheet.cols, 14);
  EXPECT_EQ(scene.sheet.structural.stiffness, 1730.0);
  EXPECT_EQ(scene.air.viscous_damping, 0.108);
}

TEST(DrawnScene, IsAnotherWithEachSeedNumberAndAttempt)
{
  std::set<std::string> texts;
  for (std::uint64_t seed = 1; seed <= 2; ++seed)
  {
    for (int number = 0; number < 20; ++number)
    {
      for (int attempt = 0; attempt < 3; ++attempt)
      {
        texts.insert(yaml_of(drawn_scene({ seed, number, attempt, 96 })));
      }
    }
  }
  EXPECT_EQ(texts.size(), 120U);
}

TEST(DrawnScene, KeepsToItsRanges)
{
  for (const SceneParams& scene : many_scenes())
  {
    const SheetProperties& sheet = scene.sheet;
    EXPECT_GE(std::min(sheet.rows, sheet.cols), 8);
    EXPECT_LE(std::max(sheet.rows, sheet.cols), 96);
    EXPECT_GE(sheet.structural.stiffness, 1e2);
    EXPECT_LE(sheet.structural.stiffness, 1e5);
    EXPECT_GE(area_density(scene), 0.05 * (1.0 - 1e-12));
    EXPECT_LE(area_density(scene), 1.0 * (1.0 + 1e-12));
    EXPECT_LE(sheet.shear.stiffness, sheet.structural.stiffness);
    EXPECT_LE(sheet.flex.stiffness, 0.3 * sheet.structural.stiffness);
    EXPECT_EQ(scene.strain_limit.max_strain, 0.0);
    EXPECT_EQ(scene.solver.method, "auto");
    EXPECT_EQ(scene.plan, "auto");
  }
}

TEST(DrawnScene, CoversItsRanges)
{
  const std::vector<SceneParams> scenes = many_scenes();
  const auto nodes = [](const SceneParams& scene) { return std::max(scene.sheet.rows, scene.sheet.cols); };
  EXPECT_GT(share_of(scenes, [&](const SceneParams& scene) { return nodes(scene) < 16; }), 0.2);
  EXPECT_GT(share_of(scenes, [&](const SceneParams& scene) { return nodes(scene) > 64; }), 0.1);
  EXPECT_GT(share_of(scenes, [](const SceneParams& scene) { return scene.sheet.structural.stiffness < 1e3; }), 0.25);
  EXPECT_GT(share_of(scenes, [](const SceneParams& scene) { return scene.sheet.structural.stiffness > 1e4; }), 0.25);
  EXPECT_GT(share_of(scenes, [](const SceneParams& scene) { return area_density(scene) < 0.1; }), 0.15);
  EXPECT_GT(share_of(scenes, [](const SceneParams& scene) { return area_density(scene) > 0.5; }), 0.15);
}

/// Each at the share by which it is drawn, within four standard deviations of 400 draws.
TEST(DrawnScene, LeavesPartsOutAsOftenAsItShould)
{
  const std::vector<SceneParams> scenes = many_scenes();
  const auto expect_share = [&](double share, bool (*has)(const SceneParams&)) {
    EXPECT_NEAR(share_of(scenes, has), share, 4.0 * std::sqrt(share * (1.0 - share) / many));
  };
  expect_share(1.0 / 8.0, [](const SceneParams& scene) { return scene.sheet.shear.stiffness == 0.0; });
  expect_share(1.0 / 6.0, [](const SceneParams& scene) { return scene.sheet.flex.stiffness == 0.0; });
  expect_share(1.0 / 8.0, [](const SceneParams& scene) { return scene.sheet.structural.damping == 0.0; });
  expect_share(1.0 / 8.0, [](const SceneParams& scene) { return scene.air.viscous_damping == 0.0; });
  expect_share(3.0 / 10.0, [](const SceneParams& scene) { return scene.air.wind_coupling == 0.0; });
  expect_share(2.0 / 5.0, [](const SceneParams& scene) { return scene.air.wind.isZero(0.0); });
  expect_share(1.0 / 5.0, [](const SceneParams& scene) { return scene.air.gusts.strength > 0.0; });
  expect_share(1.0 / 2.0, [](const SceneParams& scene) { return scene.pins.size() == 2; });
  // One pin moves in 2 of 5 cases, one of two in 16 of 25.
  expect_share(0.5 * 0.4 + 0.5 * 0.64, has_moving_pin);
}

TEST(DrawnScene, ReadsBackFromItsFileAsItWas)
{
  for (int number = 0; number < 20; ++number)
  {
    const SceneParams scene = drawn_scene({ 1, number, 0, 24 });
    const SceneParams read = scene_of(yaml_of(scene));
    EXPECT_EQ(yaml_of(read), yaml_of(scene));
    EXPECT_TRUE(make_plan(read).start.positions == make_plan(scene).start.positions);
  }
}

TEST(DrawnScene, StartsWithoutSymmetry)
{
  const SceneParams scene = drawn_scene({ 1, 2, 0, 24 });
  const ClothState start = make_plan(scene).start;
  const Vectors mirrored = start.positions.colwise().reverse();
  EXPECT_GT((start.positions.rowwise() - start.positions.row(0)).norm(), 0.0);
  EXPECT_GT(scene.start.ripple, 0.0);
  EXPECT_GT((mirrored.col(1) - start.positions.col(1)).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(DrawnScene, IsNamedByItsNumberAndAttempt)
{
  EXPECT_EQ(name_of(SceneNumber{ 1, 7, 0, 96 }), "007");
  EXPECT_EQ(name_of(SceneNumber{ 1, 7, 2, 96 }), "007_2");
  EXPECT_STREQ(name_of(half_of(6)), "development");
  EXPECT_STREQ(name_of(half_of(7)), "held_out");
}

TEST(Part, IsThereWhereTheSceneHasIt)
{
  SceneParams scene;
  EXPECT_EQ(parts_of(scene), PartNames({ "flex springs", "internal damping", "shear springs", "wind" }));
  scene.sheet.flex.stiffness = 0.0;
  scene.air.wind_coupling = 0.0;
  EXPECT_EQ(parts_of(scene), PartNames({ "internal damping", "shear springs" }));
}

TEST(Part, IsGoneOnceItIsLeftOutAndNothingElseIs)
{
  const SceneParams full;
  for (const std::string& name : parts_of(full))
  {
    PartNames others = parts_of(full);
    others.erase(name);
    EXPECT_EQ(parts_of(without({ name }, full)), others);
  }
  EXPECT_EQ(without({ "internal damping" }, full).sheet.structural.stiffness, full.sheet.structural.stiffness);
  EXPECT_THROW(without({ "sequins" }, full), std::invalid_argument);
}

}  // namespace
}  // namespace cloth
