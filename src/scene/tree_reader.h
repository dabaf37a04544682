#pragma once

#include <set>
#include <string>
#include <vector>

#include "cloth_sim/scene/parameter_table.h"
#include "cloth_sim/scene/yaml_text.h"

namespace cloth
{

inline bool begins_with(const std::string& text, const std::string& beginning)
{
  return text.compare(0, beginning.size(), beginning) == 0;
}

inline std::string fault_of(const std::string& key, const YAML::Node& value, const std::string& allowed)
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

}  // namespace cloth
