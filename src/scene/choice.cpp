#include "cloth_sim/scene/choice.h"

#include <cmath>

#include "cloth_sim/methods/method.h"
#include "cloth_sim/scene/scene_reader.h"

#include "../planning/model_parts.h"
#include "parameter_kinds.h"
#include "tree_reader.h"

namespace cloth
{
namespace
{

std::vector<std::string> optional_part_names()
{
  std::vector<std::string> names;
  for (const ModelPart& part : optional_parts())
  {
    names.push_back(part.name);
  }
  return names;
}

std::vector<std::string> method_names()
{
  std::vector<std::string> names;
  for (const MethodRow& row : methods())
  {
    names.push_back(row.name);
  }
  return names;
}

Parameter<Choice> left_out_row()
{
  const std::vector<std::string> names = optional_part_names();
  Parameter<Choice> parameter;
  parameter.key = "left_out";
  parameter.allowed = "a list of some of " + joined(names);
  parameter.set = [names](const YAML::Node& value, Choice& choice) {
    choice.left_out.clear();
    for (const YAML::Node& name : read_list(value))
    {
      if (!name.IsScalar() || std::find(names.begin(), names.end(), name.Scalar()) == names.end())
      {
        throw std::invalid_argument("no part of the model");
      }
      choice.left_out.push_back(name.Scalar());
    }
  };
  return parameter;
}

const std::vector<Parameter<Choice>>& choice_table()
{
  using Row = RowsOf<Choice>;
  static const std::vector<Parameter<Choice>> table{
    left_out_row(),
    Row::choice("method", method_names(), "", CLOTH_MEMBER(method)),
    Row::number("time_step", "s", Range{ 1e-9, true, infinity, true }, "", CLOTH_MEMBER(time_step)),
    Row::number("tolerance", "m", Range{ 1e-12, true }, "", CLOTH_MEMBER(tolerance)),
    Row::integer("iterations", 1, 10000, "", CLOTH_MEMBER(iterations)),
    Row::number("error", "m", not_negative, "", CLOTH_MEMBER(error)),
    Row::number("cost", "s", not_negative, "", CLOTH_MEMBER(cost)),
  };
  return table;
}

}  // namespace

void write_choice(YAML::Emitter& emitter, const Choice& choice)
{
  emitter << YAML::BeginMap;
  emitter << YAML::Key << "left_out" << YAML::Value << YAML::Flow << choice.left_out;
  emitter << YAML::Key << "method" << YAML::Value << choice.method;
  emitter << YAML::Key << "time_step" << YAML::Value << format_number(choice.time_step);
  emitter << YAML::Key << "tolerance" << YAML::Value << format_number(choice.tolerance);
  emitter << YAML::Key << "iterations" << YAML::Value << choice.iterations;
  for (const auto& [key, number] : { std::pair("error", choice.error), std::pair("cost", choice.cost) })
  {
    if (std::isfinite(number))
    {
      emitter << YAML::Key << key << YAML::Value << format_number(number);
    }
  }
  emitter << YAML::EndMap;
}

Choice read_choice(const YAML::Node& tree)
{
  const bool is_summary = tree.IsMap() && tree["choice"];
  const YAML::Node own = is_summary ? tree["choice"] : tree;
  std::vector<std::string> faults;
  Choice choice;
  TreeReader<Choice>(choice_table(), "choice", "", faults).read(own, choice);
  if (faults.empty() && choice.method.empty())
  {
    faults.push_back("choice has no method; allowed: " + joined(method_names()));
  }
  if (!faults.empty())
  {
    throw SceneError(faults);
  }
  return choice;
}

}  // namespace cloth
