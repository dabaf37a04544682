#include "cloth_sim/scene/pin_selection.h"

#include <map>

#include "cloth_sim/scene/plan.h"
#include "scene/scene_text.h"

namespace cloth
{
namespace
{

using Nodes = std::vector<int>;

// A sheet of three rows and four columns: nodes 0 to 3 above 4 to 7 above 8 to 11.
const char* const sheet = "cloth: {rows: 3, cols: 4}, ";

std::vector<Pin> pins_in(const std::string& yaml)
{
  const SceneParams scene = scene_of("{" + yaml + "}");
  const ClothModel model = make_sheet(scene.sheet);
  return pins_of(scene.pins, model, model.rest_positions);
}

std::string fault_of_pins(const std::string& yaml)
{
  try
  {
    pins_in(yaml);
    return {};
  }
  catch (const SceneError& error)
  {
    return error.what();
  }
}

TEST(PinSelection, KnowsEveryPlaceOfTheInterface)
{
  const std::map<std::string, Nodes> places = {
    { "top_left", { 0 } },        { "top_right", { 3 } },         { "bottom_left", { 8 } },
    { "bottom_right", { 11 } },   { "top_edge", { 0, 1, 2, 3 } }, { "bottom_edge", { 8, 9, 10, 11 } },
    { "left_edge", { 0, 4, 8 } }, { "right_edge", { 3, 7, 11 } }, { "border", { 0, 1, 2, 3, 4, 7, 8, 9, 10, 11 } },
  };
  EXPECT_EQ(pin_places().size(), places.size());
  for (const auto& [place, nodes] : places)
  {
    const std::vector<Pin> pins = pins_in(sheet + ("pins: [{name: a, at: " + place + "}]"));
    ASSERT_EQ(pins.size(), 1u) << place;
    EXPECT_EQ(pins[0].nodes, nodes) << place;
  }
}

TEST(PinSelection, CountsNegativeIndicesFromTheEnd)
{
  const std::vector<Pin> pins =
      pins_in(sheet + std::string("pins: [{name: a, nodes: [[-1, 0], [0, -1], [-3, -4], [1, 2]]}]"));
  EXPECT_EQ(pins.at(0).nodes, (Nodes{ 8, 3, 0, 6 }));
}

TEST(PinSelection, TakesANodeThatIsNamedTwiceOnce)
{
  EXPECT_EQ(pins_in(sheet + std::string("pins: [{name: a, nodes: [[2, 3], [-1, -1]]}]")).at(0).nodes, Nodes{ 11 });
}

TEST(PinSelection, NamesANodeThatIsNotOnTheSheet)
{
  for (const std::string node : { "[3, 0]", "[-4, 0]", "[0, 4]", "[0, -5]" })
  {
    EXPECT_EQ(fault_of_pins(sheet + ("pins: [{name: a, at: border}, {name: b, nodes: [[0, 0], " + node + "]}]")),
              "pins[1].nodes has " + node + "; allowed: rows -3 to 2, columns -4 to 3");
  }
}

TEST(PinSelection, GivesANodeOfTwoPinsThatMoveAlikeToTheFirst)
{
  const std::string motion = ", motion: {amplitude: [0, 0, 1], frequency: 2, phase: 3}}";
  const std::vector<Pin> pins =
      pins_in(sheet + ("pins: [{name: a, at: top_edge" + motion + ", {name: b, at: left_edge" + motion + "]"));
  ASSERT_EQ(pins.size(), 2u);
  EXPECT_EQ(pins[0].nodes, (Nodes{ 0, 1, 2, 3 }));
  EXPECT_EQ(pins[1].nodes, (Nodes{ 4, 8 }));
}

TEST(PinSelection, RefusesANodeOfTwoPinsThatMoveOtherwise)
{
  for (const std::string motion :
       { "{amplitude: [0, 0, 2], frequency: 2, phase: 3}", "{amplitude: [0, 0, 1], frequency: 3, phase: 3}",
         "{amplitude: [0, 0, 1], frequency: 2, phase: 4}", "{}" })
  {
    EXPECT_EQ(fault_of_pins(sheet +
                            ("pins: [{name: a, at: top_edge, motion: {amplitude: [0, 0, 1], frequency: 2, phase: 3}}, "
                             "{name: b, at: right_edge, motion: " +
                             motion + "}]")),
              "pins[1] (b) holds node [0, 3], which a holds too and moves otherwise; allowed: one motion a node");
  }
}

TEST(PinSelection, HoldsAChainWithTheDefaultPinsAtItsTop)
{
  const std::vector<Pin> pins = pins_in("cloth: {rows: 5, cols: 1}");
  ASSERT_EQ(pins.size(), 1u);
  EXPECT_EQ(pins[0].name, "left");
  EXPECT_EQ(pins[0].nodes, Nodes{ 0 });
  Simulation simulation = build_simulation(make_plan(scene_of("cloth: {rows: 5, cols: 1}")));
  EXPECT_TRUE(simulation.advance_to(0.1));
  EXPECT_EQ(simulation.state().positions.row(0), Eigen::RowVector3d(0.0, 0.0, 1.5));
  EXPECT_LT(simulation.state().positions(4, 2), 0.5);
}

TEST(PinSelection, FreesASheetWithoutPins)
{
  EXPECT_TRUE(pins_in("pins: []").empty());
  EXPECT_TRUE(build_simulation(make_plan(scene_of("pins: []"))).pins().all().empty());
}

TEST(PinSelection, HoldsNodesWhereTheyStart)
{
  const SceneParams scene = scene_of(
      "{cloth: {rows: 3, cols: 3, ripple: 0.1, initial_stretch: [0.5, 2], velocity: [1, 2, 3]}, "
      "pins: [{name: a, at: bottom_edge}]}");
  Simulation simulation = build_simulation(make_plan(scene));
  const Vectors start = simulation.state().positions;
  EXPECT_EQ(start(6, 2), 1.5 - 2.0);
  EXPECT_NE(start(6, 1), 0.0);
  for (int node = 0; node < 9; ++node)
  {
    const Eigen::RowVector3d expected = node < 6 ? Eigen::RowVector3d(1, 2, 3) : Eigen::RowVector3d(0, 0, 0);
    EXPECT_EQ(simulation.state().velocities.row(node), expected) << node;
  }
  simulation.advance_to(0.05);
  EXPECT_EQ(simulation.state().positions.bottomRows(3), start.bottomRows(3));
}

TEST(PinList, RefusesBadNames)
{
  for (const std::string name : { "1a", "_a", "''", "a b", "a-b", "a/b", "a.b", "~", "[a]", "{a: b}", "\"\\xe9\"" })
  {
    EXPECT_TRUE(
        has(faults_of("pins: [{at: border, name: " + name + "}]"),
            { "pins[0].name is ", "; allowed: a ROS name: a letter, then letters, digits and _; each name once" }))
        << name;
  }
  for (const std::string name : { "a", "Z9", "a_1_" })
  {
    EXPECT_EQ(faults_of("pins: [{at: border, name: " + name + "}]"), "");
  }
}

TEST(PinList, RefusesANameThatIsThereTwiceOrMissing)
{
  EXPECT_EQ(faults_of("pins: [{name: a, at: top_left}, {name: b, at: border}, {name: a, at: top_right}]"),
            "pins[2].name is a, as is another pin's; allowed: each name once");
  EXPECT_TRUE(has(faults_of("pins: [{at: border}]"), { "pins[0] has no name; allowed: a ROS name" }));
}

TEST(PinList, WantsEitherAPlaceOrNodes)
{
  EXPECT_EQ(faults_of("pins: [{name: a}]"), "pins[0] has neither at and nodes; allowed: one of them");
  EXPECT_EQ(faults_of("pins: [{name: a, at: border, nodes: [[0, 0]]}]"),
            "pins[0] has both at and nodes; allowed: one of them");
}

TEST(PinList, RefusesWhatIsNoListOfPins)
{
  for (const std::string value : { "border", "5", "{name: a}", "~", "true" })
  {
    EXPECT_EQ(faults_of("pins: " + value), "pins is " + value + "; allowed: a list of pins");
  }
  EXPECT_EQ(faults_of("pins: [border]"), "pins[0] is border; allowed: a map with name, at, nodes, motion");
  EXPECT_EQ(faults_of("pins: [{name: a, at: border, motion: 3}]"),
            "pins[0].motion is 3; allowed: a map with amplitude, frequency, phase");
}

}  // namespace
}  // namespace cloth
