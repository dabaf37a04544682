#include "part.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "cloth_sim/scene/yaml_text.h"
#include "model_parts.h"

namespace cloth
{

PartNames parts_of(const SceneParams& scene)
{
  PartNames names;
  for (const ModelPart& part : optional_parts())
  {
    if (part.is_there(scene))
    {
      names.insert(part.name);
    }
  }
  return names;
}

SceneParams without(const PartNames& names, const SceneParams& scene)
{
  const std::vector<ModelPart>& all = optional_parts();
  for (const std::string& name : names)
  {
    if (std::none_of(all.begin(), all.end(), [&name](const ModelPart& part) { return part.name == name; }))
    {
      throw std::invalid_argument("no part that can be left out is called " + name);
    }
  }
  return without(scene, std::vector<std::string>(names.begin(), names.end()));
}

std::string joined(const PartNames& names)
{
  return joined(std::vector<std::string>(names.begin(), names.end()), "+");
}

PartNames names_in(const std::string& text)
{
  PartNames names;
  std::istringstream words(text);
  for (std::string name; std::getline(words, name, '+');)
  {
    names.insert(name);
  }
  return names;
}

}  // namespace cloth
