#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "cloth_sim/scene/scene_reader.h"

namespace cloth
{

inline SceneParams scene_of(const std::string& yaml)
{
  return read_scene(YAML::Load(yaml));
}

/// What the scene is refused for; empty where it is not.
inline std::string faults_of(const YAML::Node& tree)
{
  try
  {
    read_scene(tree);
    return {};
  }
  catch (const SceneError& error)
  {
    return error.what();
  }
}

inline std::string faults_of(const std::string& yaml)
{
  return faults_of(YAML::Load(yaml));
}

inline bool contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

inline testing::AssertionResult has(const std::string& text, const std::vector<std::string>& parts)
{
  for (const std::string& part : parts)
  {
    if (!contains(text, part))
    {
      return testing::AssertionFailure() << "\"" << part << "\" is missing in \"" << text << "\"";
    }
  }
  return testing::AssertionSuccess();
}

/// The value at a dotted key; not defined where there is none.
inline YAML::Node value_at(const YAML::Node& tree, const std::string& key)
{
  const size_t dot = key.find('.');
  if (!tree.IsMap() || dot == std::string::npos)
  {
    return tree.IsMap() ? tree[key] : YAML::Node(YAML::NodeType::Undefined);
  }
  const YAML::Node below = tree[key.substr(0, dot)];
  return below.IsDefined() ? value_at(below, key.substr(dot + 1)) : below;
}

/// The same value, however it is written: 1 and 1.0, `[0, 1]` as a list and as text.
inline bool same_value(const YAML::Node& one, const YAML::Node& other)
{
  if (one.IsSequence() && other.IsSequence() && one.size() == other.size())
  {
    bool same = true;
    for (size_t i = 0; i < one.size(); ++i)
    {
      same = same && same_value(one[i], other[i]);
    }
    return same;
  }
  double a = 0.0;
  double b = 0.0;
  if (YAML::convert<double>::decode(one, a) && YAML::convert<double>::decode(other, b))
  {
    return a == b;
  }
  return one.IsScalar() && other.IsScalar() && one.Scalar() == other.Scalar();
}

}  // namespace cloth
