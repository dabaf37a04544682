#include "live_keys.h"

#include <limits>
#include <map>

#include <dynamic_reconfigure/config_tools.h>
#include <gtest/gtest.h>

#include "cloth_sim/ClothConfig.h"
#include "cloth_sim/scene/scene_reader.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothConfig;
using dynamic_reconfigure::ConfigTools;

constexpr double infinity = std::numeric_limits<double>::infinity();

dynamic_reconfigure::Config message_of(const ClothConfig& config)
{
  dynamic_reconfigure::Config message;
  config.__toMessage__(message);
  return message;
}

std::map<std::string, ClothConfig::AbstractParamDescriptionConstPtr> descriptions()
{
  std::map<std::string, ClothConfig::AbstractParamDescriptionConstPtr> by_name;
  for (const auto& description : ClothConfig::__getParamDescriptions__())
  {
    by_name[description->name] = description;
  }
  return by_name;
}

double number_in(const ClothConfig& config, const std::string& name)
{
  double value = std::numeric_limits<double>::quiet_NaN();
  int integer = 0;
  const dynamic_reconfigure::Config message = message_of(config);
  if (ConfigTools::getParameter(message, name, integer))
  {
    return integer;
  }
  ConfigTools::getParameter(message, name, value);
  return value;
}

TEST(LiveKeys, TheConfigIsMadeOfTheTable)
{
  auto left = descriptions();
  const std::map<std::string, std::string> types{
    { "number", "double" }, { "list of 3 numbers", "double" }, { "integer", "int" }, { "text", "str" }
  };
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    for (const std::string& name : parameter.live ? flat_names_of(parameter) : std::vector<std::string>())
    {
      SCOPED_TRACE(name);
      ASSERT_EQ(left.count(name), 1u);
      EXPECT_EQ(left[name]->type, types.at(parameter.type));
      EXPECT_EQ(left[name]->description, parameter.meaning);
      if (parameter.type != "text")
      {
        EXPECT_EQ(number_in(ClothConfig::__getMin__(), name), parameter.or_zero ? 0.0 : parameter.low);
        EXPECT_EQ(number_in(ClothConfig::__getMax__(), name), parameter.high);
      }
      left.erase(name);
    }
  }
  EXPECT_TRUE(left.empty()) << left.begin()->first << " is not live";
}

TEST(LiveKeys, TheConfigHasTheDefaultsOfTheTable)
{
  dynamic_reconfigure::Config defaults = message_of(ClothConfig::__getDefault__());
  defaults.groups.clear();
  const auto by_name = [](const auto& entries) {
    std::map<std::string, std::decay_t<decltype(entries[0].value)>> values;
    for (const auto& entry : entries)
    {
      values[entry.name] = entry.value;
    }
    return values;
  };
  const dynamic_reconfigure::Config table = live_values_of(SceneParams());
  EXPECT_EQ(by_name(defaults.doubles), by_name(table.doubles));
  EXPECT_EQ(by_name(defaults.ints), by_name(table.ints));
  EXPECT_EQ(by_name(defaults.strs), by_name(table.strs));
}

TEST(LiveKeys, TheMethodsOfTheConfigAreThoseOfTheTable)
{
  std::string edit_method = descriptions().at("solver_method")->edit_method;
  std::string words;
  const std::string mark = "'value': '";
  for (size_t at = edit_method.find(mark); at != std::string::npos; at = edit_method.find(mark, at))
  {
    at += mark.size();
    words += (words.empty() ? "" : ", ") + edit_method.substr(at, edit_method.find('\'', at) - at);
  }
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    EXPECT_TRUE(parameter.key != "solver.method" || parameter.allowed == "one of " + words) << words;
  }
}

TEST(LiveKeys, AreNamedFlat)
{
  std::map<std::string, std::vector<std::string>> names;
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    names[parameter.key] = flat_names_of(parameter);
  }
  using Names = std::vector<std::string>;
  EXPECT_EQ(names["springs.flex.damping"], Names{ "springs_flex_damping" });
  EXPECT_EQ(names["air.wind"], (Names{ "air_wind_x", "air_wind_y", "air_wind_z" }));
  EXPECT_EQ(names["rate"], Names{ "rate" });
}

dynamic_reconfigure::Config one_number(const std::string& name, double value)
{
  dynamic_reconfigure::Config config;
  ConfigTools::appendParameter(config, name, value);
  return config;
}

TEST(WithLiveValues, ChangesWhatIsNamedAndNothingElse)
{
  SceneParams scene;
  scene.air.wind = { 1.0, 2.0, 3.0 };
  scene.sheet.rows = 7;
  dynamic_reconfigure::Config values = one_number("air_wind_y", -4.5);
  ConfigTools::appendParameter(values, "solver_method", std::string("rk4"));
  ConfigTools::appendParameter(values, "strain_limit_sweeps", 12);
  const SceneParams changed = with_live_values(scene, values);
  EXPECT_EQ(changed.air.wind, Eigen::Vector3d(1.0, -4.5, 3.0));
  EXPECT_EQ(changed.solver.method, "rk4");
  EXPECT_EQ(changed.strain_limit.sweeps, 12);
  for (const Parameter<SceneParams>& parameter : parameter_table())
  {
    const bool named =
        parameter.key == "air.wind" || parameter.key == "solver.method" || parameter.key == "strain_limit.sweeps";
    EXPECT_TRUE(named || parameter.get(changed) == parameter.get(scene)) << parameter.key;
  }
}

TEST(WithLiveValues, ClampsToTheNearestThatIsAllowed)
{
  const SceneParams scene;
  EXPECT_EQ(with_live_values(scene, one_number("springs_shear_stiffness", -3.0)).sheet.shear.stiffness, 0.0);
  EXPECT_EQ(with_live_values(scene, one_number("springs_shear_stiffness", -infinity)).sheet.shear.stiffness, 0.0);
  EXPECT_EQ(with_live_values(scene, one_number("rate", 1e9)).node.rate, 1000.0);
  EXPECT_EQ(with_live_values(scene, one_number("rate", infinity)).node.rate, 1000.0);
  EXPECT_EQ(with_live_values(scene, one_number("rate", 0.0)).node.rate, 1e-3);
  EXPECT_EQ(with_live_values(scene, one_number("solver_time_step", 1e-12)).solver.time_step, 1e-9);
  EXPECT_EQ(with_live_values(scene, one_number("solver_time_step", -1.0)).solver.time_step, 0.0);
  dynamic_reconfigure::Config sweeps;
  ConfigTools::appendParameter(sweeps, "strain_limit_sweeps", 0);
  EXPECT_EQ(with_live_values(scene, sweeps).strain_limit.sweeps, 1);
}

TEST(WithLiveValues, RefusesWhatCannotBeClamped)
{
  const auto fault_of = [](const dynamic_reconfigure::Config& values) -> std::string {
    try
    {
      with_live_values(SceneParams(), values);
    }
    catch (const SceneError& error)
    {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(fault_of(one_number("springs_flex_damping", std::numeric_limits<double>::quiet_NaN())),
            "springs.flex.damping is .nan; allowed: a number >= 0.0");
  EXPECT_EQ(fault_of(one_number("gravity_z", infinity)),
            "gravity is [0.0, 0.0, .inf]; allowed: a list of 3 finite numbers");
  dynamic_reconfigure::Config word;
  ConfigTools::appendParameter(word, "solver_method", std::string("euler"));
  EXPECT_NE(fault_of(word).find("solver.method is euler; allowed: one of auto"), std::string::npos);
}

TEST(LiveValues, ComeBackAsTheyWere)
{
  SceneParams scene;
  scene.gravity = { 0.1, -1.0 / 3.0, 1e-300 };
  scene.solver.time_step = 1.2345678901234567e-4;
  scene.solver.method = "tr_bdf2";
  const SceneParams back = with_live_values(SceneParams(), live_values_of(scene));
  EXPECT_EQ(back.gravity, scene.gravity);
  EXPECT_EQ(back.solver.time_step, scene.solver.time_step);
  EXPECT_EQ(back.solver.method, "tr_bdf2");
}

}  // namespace
}  // namespace cloth
