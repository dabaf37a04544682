#include "cloth_sim/scene/scene_reader.h"

#include <algorithm>
#include <fstream>
#include <map>

#include "cloth_sim/scene/parameter_table.h"
#include "cloth_sim/scene/plan.h"
#include "scene/scene_text.h"

namespace cloth
{
namespace
{

// A copy of the interface, on purpose: a default that changes in the code alone must fail here.
const char* const interface_defaults = R"(
frame_id: world
gravity: [0, 0, -9.81]
cloth:
  rows: 32
  cols: 32
  width: 1.0
  height: 1.0
  mass: 0.3
  mass_lumping: area
  position: [0, 0, 1.5]
  rpy: [0, 0, 0]
  velocity: [0, 0, 0]
  initial_stretch: [1, 1]
  start: flat
  ripple: 0.0
springs:
  structural: {stiffness: 100, damping: 0.01}
  shear:      {stiffness: 100, damping: 0.01}
  flex:       {stiffness: 10,  damping: 0.0}
strain_limit: {max_strain: 0.1, sweeps: 30, solver: tensions}
air:
  viscous_damping: 0.3
  wind_coupling: 1.0
  wind: [0, 0, 0]
  gusts: {strength: 0, time_scale: 1, seed: 1}
pins:
  - {name: left,  at: top_left}
  - {name: right, at: top_right}
solver:
  method: auto
  time_step: 0
  tolerance: 1.0e-3
  iterations: 10
  compliance: 1
  precision: double
  threads: 0
plan: auto
rate: 30
real_time_factor: 1.0
clock_mode: follow
start_paused: false
start_bag: none
start_time: 0
tf_pins: {top_speed: 5.0, max_age: 1.0}
wind_timeout: 0
)";

int count_leaves(const YAML::Node& node)
{
  if (!node.IsMap())
  {
    return 1;
  }
  int leaves = 0;
  for (const auto& entry : node)
  {
    leaves += count_leaves(entry.second);
  }
  return leaves;
}

TEST(SceneReader, HasTheDefaultsOfTheInterface)
{
  const YAML::Node defaults = YAML::Load(interface_defaults);
  const SceneParams scene = scene_of("");
  int found = 0;
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    const YAML::Node expected = value_at(defaults, parameter.key);
    const bool is_display = parameter.key.compare(0, 8, "display.") == 0;
    ASSERT_TRUE(expected.IsDefined() || is_display) << parameter.key;
    if (expected.IsDefined())
    {
      ++found;
      EXPECT_TRUE(same_value(YAML::Load(parameter.get(scene)), expected))
          << parameter.key << ": " << parameter.get(scene);
    }
  }
  EXPECT_EQ(found + 1, count_leaves(defaults)) << "every key but pins is one of the table";

  ASSERT_EQ(scene.pins.size(), 2u);
  const std::map<std::string, std::string> pins{ { "left", "top_left" }, { "right", "top_right" } };
  for (const PinParams& pin : scene.pins)
  {
    EXPECT_EQ(pin.at, pins.at(pin.name));
    EXPECT_TRUE(pin.nodes.empty());
    EXPECT_TRUE(pin.motion.amplitude.isZero(0.0));
    EXPECT_EQ(pin.motion.frequency, 0.0);
    EXPECT_EQ(pin.motion.phase, 0.0);
  }
}

TEST(SceneReader, TakesTheDefaultsThatItIsGivenForTheSameScene)
{
  const SceneParams scene = scene_of(interface_defaults);
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    EXPECT_EQ(parameter.get(scene), parameter.get(SceneParams())) << parameter.key;
  }
}

TEST(SceneReader, PutsEveryKeyIntoItsOwnMember)
{
  const SceneParams scene = scene_of(R"(
frame_id: map
gravity: [0.1, 0.2, 0.3]
cloth: {rows: 5, cols: 6, width: 1.1, height: 1.2, mass: 1.3, mass_lumping: uniform, position: [1, 2, 3],
        rpy: [4, 5, 6], velocity: [7, 8, 9], initial_stretch: [1.4, 1.5], start: flat, ripple: 1.6}
springs:
  structural: {stiffness: 2.1, damping: 2.2}
  shear: {stiffness: 2.3, damping: 2.4}
  flex: {stiffness: 2.5, damping: 2.6}
strain_limit: {max_strain: 3.1, sweeps: 7, solver: sweeps}
air: {viscous_damping: 4.1, wind_coupling: 4.2, wind: [10, 11, 12],
      gusts: {strength: 4.3, time_scale: 4.4, seed: 8}}
pins:
  - {name: one, nodes: [[1, -2], [0, 0]], motion: {amplitude: [13, 14, 15], frequency: 5.1, phase: 5.2}}
solver: {method: xpbd, time_step: 6.1, tolerance: 6.2, iterations: 7, compliance: 0.3, precision: mixed, threads: 8}
plan: full
rate: 7.1
real_time_factor: 7.2
clock_mode: follow
start_paused: false
start_bag: /tmp/a cloth.bag
start_time: 7.6
tf_pins: {top_speed: 7.3, max_age: 7.4}
wind_timeout: 7.5
display: {colouring: strain, fabric_colour: [0.7, 0.8, 0.9]}
)");
  using Eigen::Vector3d;
  EXPECT_EQ(scene.frame_id, "map");
  EXPECT_EQ(scene.gravity, Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(scene.sheet.rows, 5);
  EXPECT_EQ(scene.sheet.cols, 6);
  EXPECT_EQ(scene.sheet.width, 1.1);
  EXPECT_EQ(scene.sheet.height, 1.2);
  EXPECT_EQ(scene.sheet.mass, 1.3);
  EXPECT_EQ(scene.sheet.mass_lumping, MassLumping::uniform);
  EXPECT_EQ(scene.start.position, Vector3d(1, 2, 3));
  EXPECT_EQ(scene.start.rpy, Vector3d(4, 5, 6));
  EXPECT_EQ(scene.start.velocity, Vector3d(7, 8, 9));
  EXPECT_EQ(scene.start.initial_stretch, Eigen::Vector2d(1.4, 1.5));
  EXPECT_EQ(scene.start.shape, "flat");
  EXPECT_EQ(scene.start.ripple, 1.6);
  EXPECT_EQ(scene.sheet.structural.stiffness, 2.1);
  EXPECT_EQ(scene.sheet.structural.damping, 2.2);
  EXPECT_EQ(scene.sheet.shear.stiffness, 2.3);
  EXPECT_EQ(scene.sheet.shear.damping, 2.4);
  EXPECT_EQ(scene.sheet.flex.stiffness, 2.5);
  EXPECT_EQ(scene.sheet.flex.damping, 2.6);
  EXPECT_EQ(scene.strain_limit.max_strain, 3.1);
  EXPECT_EQ(scene.strain_limit.sweeps, 7);
  EXPECT_EQ(scene.strain_limit.solver, LimitSolver::plain_sweeps);
  EXPECT_EQ(scene.air.viscous_damping, 4.1);
  EXPECT_EQ(scene.air.wind_coupling, 4.2);
  EXPECT_EQ(scene.air.wind, Vector3d(10, 11, 12));
  EXPECT_EQ(scene.air.gusts.strength, 4.3);
  EXPECT_EQ(scene.air.gusts.time_scale, 4.4);
  EXPECT_EQ(scene.air.gusts.seed, 8);
  EXPECT_EQ(scene.solver.method, "xpbd");
  EXPECT_EQ(scene.solver.time_step, 6.1);
  EXPECT_EQ(scene.solver.tolerance, 6.2);
  EXPECT_EQ(scene.solver.iterations, 7);
  EXPECT_EQ(scene.solver.compliance, 0.3);
  EXPECT_EQ(scene.solver.precision, Precision::mixed);
  EXPECT_EQ(scene.solver.threads, 8);
  EXPECT_EQ(scene.plan, "full");
  EXPECT_EQ(scene.node.rate, 7.1);
  EXPECT_EQ(scene.node.real_time_factor, 7.2);
  EXPECT_EQ(scene.node.start_bag, "/tmp/a cloth.bag");
  EXPECT_EQ(scene.node.start_time, 7.6);
  EXPECT_EQ(scene.node.tf_pins.top_speed, 7.3);
  EXPECT_EQ(scene.node.tf_pins.max_age, 7.4);
  EXPECT_EQ(scene.node.wind_timeout, 7.5);
  EXPECT_EQ(scene.node.colouring, "strain");
  EXPECT_EQ(scene.node.fabric_colour, Vector3d(0.7, 0.8, 0.9));
  ASSERT_EQ(scene.pins.size(), 1u);
  EXPECT_EQ(scene.pins[0].name, "one");
  EXPECT_EQ(scene.pins[0].nodes, (std::vector<std::array<int, 2>>{ { 1, -2 }, { 0, 0 } }));
  EXPECT_EQ(scene.pins[0].motion.amplitude, Vector3d(13, 14, 15));
  EXPECT_EQ(scene.pins[0].motion.frequency, 5.1);
  EXPECT_EQ(scene.pins[0].motion.phase, 5.2);
}

TEST(SceneReader, RunsAnEmptyScene)
{
  for (const char* const yaml : { "", "{}", "~", "# a comment alone", "---" })
  {
    const SceneParams scene = scene_of(yaml);
    EXPECT_EQ(scene.sheet.rows, 32) << yaml;
    EXPECT_EQ(scene.pins.size(), 2u) << yaml;
  }
  Simulation simulation = build_simulation(make_plan(scene_of("")));
  EXPECT_TRUE(simulation.advance_to(0.02));
}

TEST(SceneReader, TakesTextThatReadsAsTheDueNumberOrList)
{
  const SceneParams scene =
      scene_of(R"({gravity: "[0,0,-1]", cloth: {rows: "7", mass: "2"}, solver: {time_step: "1e-3"},
    pins: "[{name: a, nodes: '[[0, 0]]', motion: {amplitude: '[1, 0, 0]', frequency: '2'}}]"})");
  EXPECT_EQ(scene.gravity, Eigen::Vector3d(0.0, 0.0, -1.0));
  EXPECT_EQ(scene.sheet.rows, 7);
  EXPECT_EQ(scene.sheet.mass, 2.0);
  EXPECT_EQ(scene.solver.time_step, 1e-3);
  ASSERT_EQ(scene.pins.size(), 1u);
  EXPECT_EQ(scene.pins[0].nodes.size(), 1u);
  EXPECT_EQ(scene.pins[0].motion.amplitude, Eigen::Vector3d(1.0, 0.0, 0.0));
  EXPECT_EQ(scene.pins[0].motion.frequency, 2.0);
}

TEST(SceneReader, TakesAnIntegerForANumberButNoNumberForAnInteger)
{
  EXPECT_EQ(scene_of("cloth: {mass: 2}").sheet.mass, 2.0);
  EXPECT_EQ(faults_of("cloth: {rows: 32.0}"), "cloth.rows is 32.0; allowed: an integer from 1 to 4096");
}

TEST(SceneReader, GathersAllFaults)
{
  const std::string faults = faults_of(R"({gravity: [0, 0], cloth: {rows: 0, mass: heavy, colour: red}, sprigns: {},
    pins: [{name: 1a, at: middle}, 5], solver: {method: leapfrog}})");
  EXPECT_TRUE(has(faults, { "gravity is [0, 0]; ", "cloth.rows is 0; ", "cloth.mass is heavy; ", "cloth.colour is not ",
                            "sprigns is not ", "pins[0].name is 1a; ", "pins[0].at is middle; ", "pins[1] is 5; ",
                            "solver.method is leapfrog; " }));
  EXPECT_EQ(std::count(faults.begin(), faults.end(), '\n') + 1, 9) << faults;
}

TEST(SceneReader, RefusesWhatIsNoMapWhereAMapIsDue)
{
  EXPECT_TRUE(has(faults_of("[1, 2]"), { "the scene is [1, 2]; allowed: a map with frame_id, ", ", pins" }));
  EXPECT_TRUE(has(faults_of("rows"), { "the scene is rows; allowed: a map with " }));
  EXPECT_EQ(faults_of("springs: {flex: 10}"), "springs.flex is 10; allowed: a map with stiffness, damping");
  EXPECT_EQ(faults_of("springs: [1]"), "springs is [1]; allowed: a map with structural, shear, flex");
}

TEST(SceneReader, RefusesAKeyThatIsThereTwice)
{
  EXPECT_EQ(faults_of("{gravity: [0, 0, 0], gravity: [0, 0, 1]}"), "gravity is there twice; allowed: once");
  EXPECT_EQ(faults_of("cloth: {rows: 2, rows: 2}"), "cloth.rows is there twice; allowed: once");
  EXPECT_EQ(faults_of("{cloth: {rows: 2}, cloth: {cols: 2}}"), "cloth is there twice; allowed: once");
  EXPECT_EQ(faults_of("pins: [{name: a, name: b, at: border}]"), "pins[0].name is there twice; allowed: once");
  EXPECT_EQ(faults_of("{pins: [], pins: []}"), "pins is there twice; allowed: once");
}

TEST(SceneReader, RefusesADottedKeyInATree)
{
  EXPECT_TRUE(
      has(faults_of("{cloth.rows: 4, cloth: {rows: 5}}"), { "cloth.rows is not a key; allowed in the scene: " }));
  EXPECT_TRUE(
      has(faults_of("springs: {flex.damping: 4}"), { "springs.flex.damping is not a key; allowed in springs: " }));
}

TEST(SceneReader, RefusesASheetOfOneNode)
{
  EXPECT_EQ(faults_of("cloth: {rows: 1, cols: 1}"), "cloth.rows is 1 and cloth.cols is 1; allowed: two nodes at least");
  EXPECT_EQ(faults_of("cloth: {rows: 1, cols: 2}"), "");
  EXPECT_EQ(faults_of("cloth: {rows: 2, cols: 1}"), "");
}

TEST(SceneReader, CutsAVeryLongValueInAFault)
{
  const std::string faults = faults_of("cloth: {mass: " + std::string(5000, 'x') + "}");
  EXPECT_TRUE(has(faults, { "cloth.mass is xxx", "...; allowed: a number > 0.0" }));
  EXPECT_LT(faults.size(), 200u);
}

TEST(OverrideKey, SetsWhatIsThereAndWhatIsNot)
{
  YAML::Node tree = YAML::Load("{cloth: {rows: 4, cols: 5}}");
  override_key(tree, "cloth.rows", "6");
  override_key(tree, "springs.flex.stiffness", "0");
  override_key(tree, "gravity", "[0, 0, -1]");
  override_key(tree, "springs.flex.damping", "0.5");
  override_key(tree, "pins", "[]");
  const SceneParams scene = read_scene(tree);
  EXPECT_EQ(scene.sheet.rows, 6);
  EXPECT_EQ(scene.sheet.cols, 5);
  EXPECT_EQ(scene.sheet.flex.stiffness, 0.0);
  EXPECT_EQ(scene.sheet.flex.damping, 0.5);
  EXPECT_EQ(scene.gravity, Eigen::Vector3d(0.0, 0.0, -1.0));
  EXPECT_TRUE(scene.pins.empty());
}

TEST(OverrideKey, ChangesOneOfTwoKeysThatShareAValue)
{
  YAML::Node tree = YAML::Load("springs: {structural: &same {stiffness: 5, damping: 0}, shear: *same}");
  override_key(tree, "springs.structural.stiffness", "7");
  const SceneParams scene = read_scene(tree);
  EXPECT_EQ(scene.sheet.structural.stiffness, 7.0);
  EXPECT_EQ(scene.sheet.shear.stiffness, 5.0);
}

TEST(OverrideKey, LeavesUnknownKeysToTheReader)
{
  for (const char* const key : { "cloth.colour", "colour", "cloth.", ".rows", "cloth..rows", "" })
  {
    YAML::Node tree;
    override_key(tree, key, "1");
    EXPECT_TRUE(has(faults_of(tree), { "is not a key; allowed in " })) << key;
  }
}

TEST(OverrideKey, SetsAnEmptyValueToNull)
{
  YAML::Node tree;
  override_key(tree, "cloth.mass", "");
  EXPECT_EQ(faults_of(tree), "cloth.mass is ~; allowed: a number > 0.0");
}

TEST(OverrideKey, RefusesAKeyBelowWhatIsNoMapAndAValueThatIsNoYaml)
{
  const std::map<std::array<std::string, 2>, std::string> cases = {
    { { "cloth.rows.first", "1" }, "cloth.rows.first cannot be set: cloth.rows is 4, not a map" },
    { { "gravity.z", "1" }, "gravity.z cannot be set: gravity is [0, 0, 0], not a map" },
    { { "gravity", "[0, 0" }, "gravity is [0, 0, which is no YAML: " },
  };
  for (const auto& [setting, expected] : cases)
  {
    YAML::Node tree = YAML::Load("{cloth: {rows: 4}, gravity: [0, 0, 0]}");
    try
    {
      override_key(tree, setting[0], setting[1]);
      ADD_FAILURE() << setting[0] << " was set";
    }
    catch (const SceneError& error)
    {
      EXPECT_TRUE(has(error.what(), { expected }));
    }
  }
}

TEST(LoadSceneFile, NamesTheFileThatCannotBeUsed)
{
  const std::string path = testing::TempDir() + "cloth_sim_scene_reader_test.yaml";
  const std::map<std::string, std::string> cases = {
    { "cloth: {rows: 4", " is no YAML: " },
    { "a: 1\n---\na: 2\n", " holds 2 YAML documents; allowed: one" },
  };
  const auto fault_of_loading = [](const std::string& file) -> std::string {
    try
    {
      load_scene_file(file);
      return {};
    }
    catch (const SceneError& error)
    {
      return error.what();
    }
  };
  for (const auto& [text, expected] : cases)
  {
    std::ofstream(path) << text;
    EXPECT_TRUE(has(fault_of_loading(path), { path + expected }));
  }
  std::ofstream(path) << "# nothing but a comment\n";
  EXPECT_EQ(fault_of_loading(path), "");
  std::remove(path.c_str());
  EXPECT_EQ(fault_of_loading(path), path + " cannot be read");
  EXPECT_EQ(fault_of_loading("config"), "config cannot be read; allowed: a file");
}

}  // namespace
}  // namespace cloth
