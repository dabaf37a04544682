#include "cloth_sim/scene/parameter_table.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "cloth_sim/scene/yaml_text.h"
#include "scene/scene_text.h"

namespace cloth
{
namespace
{

using Strings = std::vector<std::string>;

/// Where a table's keys stand in a scene, so that one loop serves for both tables.
template <typename Target>
struct Place;

template <>
struct Place<SceneParams>
{
  static const std::vector<Parameter<SceneParams>>& table()
  {
    return parameter_table();
  }
  static std::string full(const std::string& key)
  {
    return key.empty() ? "the scene" : key;
  }
  static YAML::Node tree(const std::string& key, const std::string& value)
  {
    YAML::Node tree;
    override_key(tree, key, value);
    return tree;
  }
  static const SceneParams& target(const SceneParams& scene)
  {
    return scene;
  }
};

template <>
struct Place<PinParams>
{
  static const std::vector<Parameter<PinParams>>& table()
  {
    return pin_table();
  }
  static std::string full(const std::string& key)
  {
    return key.empty() ? "pins[0]" : "pins[0]." + key;
  }
  /// A pin that is complete besides `key`.
  static YAML::Node tree(const std::string& key, const std::string& value)
  {
    YAML::Node pin;
    override_key(pin, "name", "hook");
    if (key != "nodes")
    {
      override_key(pin, "at", "border");
    }
    override_key(pin, key, value);
    YAML::Node tree;
    tree["pins"].push_back(pin);
    return tree;
  }
  static const PinParams& target(const SceneParams& scene)
  {
    return scene.pins.at(0);
  }
};

template <typename Target>
class ParameterTable : public testing::Test
{
protected:
  using At = Place<Target>;

  static void expect_refused(const Parameter<Target>& parameter, const std::string& value)
  {
    const std::string faults = faults_of(At::tree(parameter.key, value));
    const std::string expected =
        At::full(parameter.key) + " is " + shown(YAML::Load(value)) + "; allowed: " + parameter.allowed;
    EXPECT_EQ(faults, expected) << "for " << value;
  }
};

using Tables = testing::Types<SceneParams, PinParams>;
TYPED_TEST_SUITE(ParameterTable, Tables);

/// The words that a key takes; none where it is not one of some words.
template <typename Target>
Strings words_of(const Parameter<Target>& parameter)
{
  Strings words;
  const std::string start = "one of ";
  if (parameter.allowed.compare(0, start.size(), start) == 0)
  {
    std::istringstream list(parameter.allowed.substr(start.size()));
    for (std::string word; std::getline(list, word, ',');)
    {
      words.push_back(word.substr(word.find_first_not_of(' ')));
    }
  }
  return words;
}

/// Values that the key takes and that are not its default, as they come back.
template <typename Target>
Strings values_to_try(const Parameter<Target>& parameter)
{
  const std::map<std::string, Strings> by_type = {
    { "integer", { "7" } },
    { "number", { "0.6250000000000001" } },
    { "list of 2 numbers", { "[0.25, 0.5]" } },
    { "list of 3 numbers", { "[0.25, 0.5, 0.125]" } },
    { "list of [row, col]", { "[[0, 1], [-2, -1]]" } },
    { "path", { "/tmp/a cloth.bag" } },
  };
  const auto found = by_type.find(parameter.type);
  Strings values = found != by_type.end() ? found->second : words_of(parameter);
  if (values.empty())
  {
    values.push_back("lantern_2");
  }
  const std::string default_value = parameter.get(Target());
  values.erase(std::remove(values.begin(), values.end(), default_value), values.end());
  return values;
}

TYPED_TEST(ParameterTable, EveryKeyIsReadAndChangesNothingElse)
{
  using At = Place<TypeParam>;
  for (const Parameter<TypeParam>& parameter : At::table())
  {
    const Strings values = values_to_try(parameter);
    EXPECT_FALSE(values.empty()) << parameter.key;
    for (const std::string& value : values)
    {
      const SceneParams scene = read_scene(At::tree(parameter.key, value));
      EXPECT_EQ(parameter.get(At::target(scene)), value) << parameter.key;
      for (const Parameter<TypeParam>& other : At::table())
      {
        const bool is_set = other.key == parameter.key || other.key == "name" || other.key == "at";
        EXPECT_TRUE(is_set || other.get(At::target(scene)) == other.get(TypeParam()))
            << parameter.key << " changes " << other.key;
      }
    }
  }
}

TYPED_TEST(ParameterTable, EveryKeyRefusesWrongTypes)
{
  for (const Parameter<TypeParam>& parameter : Place<TypeParam>::table())
  {
    Strings wrong{ "{a: 1}", "[{a: 1}]", "[]", "~", "''" };
    if (parameter.type != "text")
    {
      wrong.insert(wrong.end(), { "text", "true", "1 m", "1,5" });
    }
    if (parameter.type == "integer" || parameter.type == "number")
    {
      wrong.insert(wrong.end(), { "[1]", ".nan", ".inf", "-.inf", "1e999", "nan", "inf", "0x", "--1", "+-1" });
    }
    if (parameter.type == "integer")
    {
      wrong.insert(wrong.end(), { "32.0", "1e1", "99999999999999999999", "0x20" });
    }
    if (parameter.type == "list of 3 numbers")
    {
      wrong.insert(wrong.end(), { "[1, 1]", "[1, 1, 1, 1]", "[1, 1, .nan]", "[.inf, 1, 1]", "[1, a, 1]", "[1, true, 1]",
                                  "[[1, 1, 1]]", "1", "'[1, 1'", "'[1, 1, .nan]'" });
    }
    if (parameter.type == "list of 2 numbers")
    {
      wrong.insert(wrong.end(), { "[1]", "[1, 1, 1]", "[1, .nan]", "[-.inf, 1]", "[1, a]", "1" });
    }
    if (parameter.type == "list of [row, col]")
    {
      wrong.insert(wrong.end(),
                   { "[1, 1]", "[[1]]", "[[1, 1, 1]]", "[[1, 1.0]]", "[[1, .nan]]", "[[1, a]]", "[[1, +-1]]" });
    }
    if (!words_of(parameter).empty())
    {
      wrong.insert(wrong.end(), { "nonsense", "7", words_of(parameter).front() + "_" });
    }
    for (const std::string& value : wrong)
    {
      this->expect_refused(parameter, value);
    }
  }
}

/// The edge of what is allowed, written apart from the table: just outside and just inside.
struct Edge
{
  const char* key;
  Strings refused;
  Strings accepted;
};

template <typename Target>
std::vector<Edge> edges();

const Strings below_zero{ "-1.0e-300", "-1" };
const Strings zero_or_below{ "0", "-0.0", "-1" };

template <>
std::vector<Edge> edges<SceneParams>()
{
  std::vector<Edge> list{
    { "cloth.rows", { "0", "-1", "4097" }, { "1", "+2" } },
    { "cloth.cols", { "0", "-1", "4097" }, { "1", "2" } },
    { "cloth.initial_stretch", { "[0, 1]", "[1, 0]", "[1, -1]" }, { "[1.0e-6, 2]" } },
    { "air.gusts.time_scale", { "0", "-1", "9.0e-4" }, { "0.001", "1.0e6" } },
    { "air.gusts.seed", { "-1", "2147483648", "0.5" }, { "0", "2147483647" } },
    { "strain_limit.sweeps", { "0", "-1", "100001" }, { "1", "100000" } },
    { "solver.iterations", { "0", "-1", "10001" }, { "1", "10000" } },
    { "solver.compliance", { "-0.1", "1.1" }, { "0", "0.5", "1" } },
    { "solver.threads", { "-1", "65", "1.5" }, { "0", "1", "64" } },
    { "solver.time_step", { "-1", "1.0e-300", "9.0e-10" }, { "0", "1.0e-9", "1" } },
    { "solver.tolerance", { "0", "-1", "9.0e-13" }, { "1.0e-12", "1" } },
    { "start_bag", { "cloth.bag", "~/cloth.bag" }, { "none", "/cloth.bag", "/tmp/a cloth.bag" } },
    { "start_time", { "-1.0e-300", "-1", "1.0e10" }, { "0", "2.5" } },
    { "rate", { "0", "-1", "9.0e-4", "1000.001" }, { "1000", "0.001" } },
    { "display.fabric_colour", { "[0, 0, 1.01]", "[-0.01, 0, 0]" }, { "[0, 1, 0.5]" } },
  };
  for (const char* const positive : { "cloth.width", "cloth.height", "cloth.mass", "tf_pins.top_speed" })
  {
    list.push_back({ positive, zero_or_below, { "1.0e-300", "1" } });
  }
  for (const char* const not_negative :
       { "springs.structural.stiffness", "springs.structural.damping", "springs.shear.stiffness",
         "springs.shear.damping", "springs.flex.stiffness", "springs.flex.damping", "strain_limit.max_strain",
         "air.viscous_damping", "air.wind_coupling", "real_time_factor", "tf_pins.max_age", "wind_timeout",
         "air.gusts.strength" })
  {
    list.push_back({ not_negative, below_zero, { "0", "1.0e-300", "1.0e6" } });
  }
  list.push_back({ "cloth.ripple", {}, { "-1", "0", "1.0e6" } });
  for (const char* const any : { "gravity", "cloth.position", "cloth.rpy", "cloth.velocity", "air.wind" })
  {
    list.push_back({ any, {}, { "[-1, 0, 1.0e6]" } });
  }
  return list;
}

template <>
std::vector<Edge> edges<PinParams>()
{
  return { { "motion.frequency", below_zero, { "0", "2" } },
           { "motion.phase", {}, { "-4", "4" } },
           { "motion.amplitude", {}, { "[-1, 0, 1]" } },
           { "nodes", {}, { "[[0, -1]]", "[[0, 0], [0, 0]]" } } };
}

TYPED_TEST(ParameterTable, EveryNumericKeyHasItsRange)
{
  using At = Place<TypeParam>;
  std::set<std::string> seen;
  for (const Edge& edge : edges<TypeParam>())
  {
    seen.insert(edge.key);
    for (const Parameter<TypeParam>& parameter : At::table())
    {
      for (const std::string& value : parameter.key == edge.key ? edge.refused : Strings())
      {
        this->expect_refused(parameter, value);
      }
    }
    for (const std::string& value : edge.accepted)
    {
      EXPECT_EQ(faults_of(At::tree(edge.key, value)), "") << edge.key << ": " << value;
    }
  }
  for (const Parameter<TypeParam>& parameter : At::table())
  {
    EXPECT_EQ(seen.count(parameter.key), parameter.type == "text" ? 0u : 1u) << parameter.key;
  }
}

/// The words below `level`, each once, as a list.
template <typename Target>
std::string siblings(const std::string& level)
{
  const std::string path = level.empty() ? "" : level + ".";
  Strings words;
  for (const Parameter<Target>& parameter : Place<Target>::table())
  {
    if (parameter.key.compare(0, path.size(), path) == 0)
    {
      words.push_back(parameter.key.substr(path.size(), parameter.key.find('.', path.size()) - path.size()));
    }
  }
  words.erase(std::unique(words.begin(), words.end()), words.end());
  if (level.empty() && std::is_same<Target, SceneParams>::value)
  {
    words.push_back("pins");
  }
  return joined(words);
}

TYPED_TEST(ParameterTable, EveryMisspeltKeyIsRefusedAtItsLevelWithTheKeysThatAreAllowed)
{
  using At = Place<TypeParam>;
  for (const Parameter<TypeParam>& parameter : At::table())
  {
    for (size_t end = parameter.key.find('.');; end = parameter.key.find('.', end + 1))
    {
      const std::string right = parameter.key.substr(0, end);
      const size_t dot = right.rfind('.');
      const std::string level = dot == std::string::npos ? "" : right.substr(0, dot);
      const std::string misspelt = right + "x";
      const std::string rest = end == std::string::npos ? "" : parameter.key.substr(end);
      EXPECT_EQ(faults_of(At::tree(misspelt + rest, "1")), At::full(misspelt) + " is not a key; allowed in " +
                                                               At::full(level) + ": " + siblings<TypeParam>(level));
      if (end == std::string::npos)
      {
        break;
      }
    }
  }
}

TYPED_TEST(ParameterTable, EveryKeyIsThereOnceAndIsExplained)
{
  std::set<std::string> keys;
  for (const Parameter<TypeParam>& parameter : Place<TypeParam>::table())
  {
    EXPECT_TRUE(keys.insert(parameter.key).second) << parameter.key;
    EXPECT_FALSE(parameter.type.empty() || parameter.allowed.empty() || parameter.meaning.empty()) << parameter.key;
  }
}

TEST(ParameterTableLive, AreTheKeysOfTheInterface)
{
  const std::set<std::string> interface_keys = { "gravity",
                                                 "springs.structural.stiffness",
                                                 "springs.structural.damping",
                                                 "springs.shear.stiffness",
                                                 "springs.shear.damping",
                                                 "springs.flex.stiffness",
                                                 "springs.flex.damping",
                                                 "strain_limit.max_strain",
                                                 "strain_limit.sweeps",
                                                 "air.viscous_damping",
                                                 "air.wind_coupling",
                                                 "air.wind",
                                                 "air.gusts.strength",
                                                 "air.gusts.time_scale",
                                                 "air.gusts.seed",
                                                 "solver.method",
                                                 "solver.time_step",
                                                 "solver.tolerance",
                                                 "solver.iterations",
                                                 "solver.compliance",
                                                 "rate",
                                                 "real_time_factor" };
  std::set<std::string> keys;
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    if (parameter.live)
    {
      keys.insert(parameter.key);
    }
  }
  EXPECT_EQ(keys, interface_keys);
}

TEST(ParameterTableWords, AreThoseOfTheInterface)
{
  const std::map<std::string, std::set<std::string>> interface_words = {
    { "cloth.mass_lumping", { "area", "uniform" } },
    { "strain_limit.solver", { "tensions", "sweeps" } },
    { "cloth.start", { "flat", "catenary", "settled" } },
    { "solver.method",
      { "auto", "explicit_euler", "symplectic_euler", "velocity_verlet", "midpoint", "rk4", "dopri5", "implicit_euler",
        "implicit_midpoint", "tr_bdf2", "projective", "xpbd" } },
    { "solver.precision", { "double", "mixed" } },
    { "clock_mode", { "follow", "master" } },
    { "plan", { "auto", "full" } },
    { "start_paused", { "false", "true" } },
  };
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    const auto expected = interface_words.find(parameter.key);
    if (expected != interface_words.end())
    {
      const Strings built = words_of(parameter);
      std::set<std::string> words(built.begin(), built.end());
      EXPECT_EQ(words, expected->second) << parameter.key;
    }
  }
}

}  // namespace
}  // namespace cloth
