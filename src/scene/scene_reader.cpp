#include "cloth_sim/scene/scene_reader.h"

#include <algorithm>
#include <ios>
#include <set>

#include "cloth_sim/scene/parameter_table.h"
#include "cloth_sim/scene/yaml_text.h"
#include "parameter_kinds.h"

namespace cloth
{
namespace
{

bool begins_with(const std::string& text, const std::string& beginning)
{
  return text.compare(0, beginning.size(), beginning) == 0;
}

std::string fault_of(const std::string& key, const YAML::Node& value, const std::string& allowed)
{
  return key + " is " + shown(value) + "; allowed: " + allowed;
}

/// Takes a tree of keys apart along a table and gathers the faults.
template <typename Target>
class TreeReader
{
public:
  /// `name` is what the tree is called in faults; empty for a whole scene. The entry `list_key` is left to the caller.
  TreeReader(const std::vector<Parameter<Target>>& table, const std::string& name, const std::string& list_key,
             std::vector<std::string>& faults)
    : table_(table), name_(name), list_key_(list_key), faults_(faults)
  {
  }

  void read(const YAML::Node& tree, Target& target)
  {
    read_map(tree, "", target);
  }

private:
  /// `path` is that of the map within the tree, with a dot at its end; empty for the whole tree.
  void read_map(const YAML::Node& map, const std::string& path, Target& target)
  {
    if (!map.IsMap())
    {
      faults_.push_back(fault_of(full_name(path), map, "a map with " + keys_below(path)));
      return;
    }
    std::set<std::string> seen;
    for (const auto& entry : map)
    {
      const std::string key = path + shown(entry.first);
      if (!seen.insert(key).second)
      {
        faults_.push_back(full_name(key) + " is there twice; allowed: once");
      }
      else if (key.find('.', path.size()) != std::string::npos)
      {
        add_unknown(key, path);
      }
      else if (key != list_key_)
      {
        read_entry(key, path, entry.second, target);
      }
    }
  }

  void read_entry(const std::string& key, const std::string& path, const YAML::Node& value, Target& target)
  {
    for (const Parameter<Target>& parameter : table_)
    {
      if (parameter.key == key)
      {
        set(parameter, value, target);
        return;
      }
      if (begins_with(parameter.key, key + "."))
      {
        read_map(value, key + ".", target);
        return;
      }
    }
    add_unknown(key, path);
  }

  void add_unknown(const std::string& key, const std::string& path)
  {
    faults_.push_back(full_name(key) + " is not a key; allowed in " + full_name(path) + ": " + keys_below(path));
  }

  void set(const Parameter<Target>& parameter, const YAML::Node& value, Target& target)
  {
    try
    {
      parameter.set(value, target);
    }
    catch (const std::exception&)
    {
      faults_.push_back(fault_of(full_name(parameter.key), value, parameter.allowed));
    }
  }

  std::string full_name(const std::string& path) const
  {
    const std::string key = path.empty() || path.back() != '.' ? path : path.substr(0, path.size() - 1);
    if (name_.empty())
    {
      return key.empty() ? "the scene" : key;
    }
    return key.empty() ? name_ : name_ + "." + key;
  }

  /// The keys that a map may have, without those of the maps in it.
  std::string keys_below(const std::string& path) const
  {
    std::vector<std::string> keys;
    for (const Parameter<Target>& parameter : table_)
    {
      if (!begins_with(parameter.key, path))
      {
        continue;
      }
      const std::string key = parameter.key.substr(path.size(), parameter.key.find('.', path.size()) - path.size());
      if (keys.empty() || keys.back() != key)
      {
        keys.push_back(key);
      }
    }
    if (path.empty() && !list_key_.empty())
    {
      keys.push_back(list_key_);
    }
    return joined(keys);
  }

  const std::vector<Parameter<Target>>& table_;
  const std::string name_;
  const std::string list_key_;
  std::vector<std::string>& faults_;
};

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
