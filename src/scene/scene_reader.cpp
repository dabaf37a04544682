#include "cloth_sim/scene/scene_reader.h"

#include <algorithm>
#include <ios>
#include <set>

#include "cloth_sim/scene/parameter_table.h"
#include "cloth_sim/scene/yaml_text.h"
#include "parameter_kinds.h"
#include "tree_reader.h"

namespace cloth
{
namespace
{

PinParams read_pin(const YAML::Node& entry, const std::string& path, std::vector<std::string>& faults)
{
  PinParams pin;
  TreeReader<PinParams>(pin_table(), path, "", faults).read(entry, pin);
  if (!entry.IsMap())
  {
    return pin;
  }
  if (!entry["name"])
  {
    faults.push_back(path + " has no name; allowed: " + pin_table().front().allowed);
  }
  const bool has_place = entry["at"].IsDefined();
  if (has_place == entry["nodes"].IsDefined())
  {
    faults.push_back(path + " has " + (has_place ? "both" : "neither") + " at and nodes; allowed: one of them");
  }
  return pin;
}

std::vector<PinParams> read_pins(const YAML::Node& value, std::vector<std::string>& faults)
{
  std::vector<PinParams> pins;
  YAML::Node list;
  try
  {
    list = read_list(value);
  }
  catch (const std::exception&)
  {
    faults.push_back(fault_of("pins", value, "a list of pins"));
    return pins;
  }
  std::set<std::string> names;
  for (size_t i = 0; i < list.size(); ++i)
  {
    const std::string path = "pins[" + std::to_string(i) + "]";
    pins.push_back(read_pin(list[i], path, faults));
    const std::string& name = pins.back().name;
    if (!name.empty() && !names.insert(name).second)
    {
      faults.push_back(path + ".name is " + name + ", as is another pin's; allowed: each name once");
    }
  }
  return pins;
}

/// Sets what `key` names from its character `begin` on. The maps on the way are copied: one that YAML shares between
/// two keys changes at one of them only.
void set_below(YAML::Node& tree, const std::string& key, size_t begin, const YAML::Node& value)
{
  if (tree.IsDefined() && !tree.IsNull() && !tree.IsMap())
  {
    const std::string name = begin == 0 ? "the scene" : key.substr(0, begin - 1);
    throw SceneError(key + " cannot be set: " + name + " is " + shown(tree) + ", not a map");
  }
  const size_t dot = key.find('.', begin);
  const std::string word = key.substr(begin, dot - begin);
  YAML::Node replaced = value;
  if (dot != std::string::npos)
  {
    replaced.reset(tree.IsMap() && tree[word] ? tree[word] : YAML::Node());
    set_below(replaced, key, dot + 1, value);
  }
  YAML::Node copy(YAML::NodeType::Map);
  bool is_set = false;
  for (const auto& entry : tree)
  {
    const bool is_it = !is_set && entry.first.IsScalar() && entry.first.Scalar() == word;
    copy.force_insert(entry.first, is_it ? replaced : entry.second);
    is_set = is_set || is_it;
  }
  if (!is_set)
  {
    copy.force_insert(word, replaced);
  }
  tree.reset(copy);
}

}  // namespace

SceneError::SceneError(const std::vector<std::string>& faults) : std::runtime_error(joined(faults, "\n"))
{
}

SceneError::SceneError(const std::string& fault) : std::runtime_error(fault)
{
}

SceneParams read_scene(const YAML::Node& tree)
{
  SceneParams scene;
  if (!tree.IsDefined() || tree.IsNull())
  {
    return scene;
  }
  std::vector<std::string> faults;
  TreeReader<SceneParams>(parameter_table(), "", "pins", faults).read(tree, scene);
  if (tree.IsMap() && tree["pins"])
  {
    scene.pins = read_pins(tree["pins"], faults);
  }
  if (scene.sheet.rows == 1 && scene.sheet.cols == 1)
  {
    faults.push_back("cloth.rows is 1 and cloth.cols is 1; allowed: two nodes at least");
  }
  if (!faults.empty())
  {
    throw SceneError(faults);
  }
  return scene;
}

YAML::Node load_scene_file(const std::string& path)
{
  std::vector<YAML::Node> documents;
  try
  {
    documents = YAML::LoadAllFromFile(path);
  }
  catch (const YAML::BadFile&)
  {
    throw SceneError(path + " cannot be read");
  }
  catch (const YAML::Exception& error)
  {
    throw SceneError(path + " is no YAML: " + error.what());
  }
  catch (const std::ios_base::failure&)
  {
    throw SceneError(path + " cannot be read; allowed: a file");
  }
  if (documents.size() > 1)
  {
    throw SceneError(path + " holds " + std::to_string(documents.size()) + " YAML documents; allowed: one");
  }
  return documents.empty() ? YAML::Node() : documents.front();
}

void override_key(YAML::Node& tree, const std::string& key, const std::string& value)
{
  YAML::Node parsed;
  try
  {
    parsed = YAML::Load(value);
  }
  catch (const YAML::Exception& error)
  {
    throw SceneError(key + " is " + value + ", which is no YAML: " + error.what());
  }
  set_below(tree, key, 0, parsed);
}

}  // namespace cloth
