#include "part.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "cloth_sim/scene/yaml_text.h"

namespace cloth
{
namespace
{

bool has_springs(const SpringProperties& springs)
{
  return springs.stiffness > 0.0;
}

bool are_damped(const SpringProperties& springs)
{
  return has_springs(springs) && springs.damping > 0.0;
}

bool has_damped_springs(const SceneParams& scene)
{
  return are_damped(scene.sheet.structural) || are_damped(scene.sheet.shear) || are_damped(scene.sheet.flex);
}

void remove_internal_damping(SceneParams& scene)
{
  scene.sheet.structural.damping = 0.0;
  scene.sheet.shear.damping = 0.0;
  scene.sheet.flex.damping = 0.0;
}

}  // namespace

const std::vector<Part>& parts()
{
  static const std::vector<Part> all{
    { "shear springs", [](const SceneParams& scene) { return has_springs(scene.sheet.shear); },
      [](SceneParams& scene) {
        scene.sheet.shear = { 0.0, 0.0 };
      } },
    { "flex springs", [](const SceneParams& scene) { return has_springs(scene.sheet.flex); },
      [](SceneParams& scene) {
        scene.sheet.flex = { 0.0, 0.0 };
      } },
    { "internal damping", has_damped_springs, remove_internal_damping },
    { "wind", [](const SceneParams& scene) { return scene.air.wind_coupling > 0.0; },
      [](SceneParams& scene) { scene.air.wind_coupling = 0.0; } },
  };
  return all;
}

PartNames parts_of(const SceneParams& scene)
{
  PartNames names;
  for (const Part& part : parts())
  {
    if (part.is_in(scene))
    {
      names.insert(part.name);
    }
  }
  return names;
}

SceneParams without(const PartNames& names, SceneParams scene)
{
  for (const std::string& name : names)
  {
    const auto found =
        std::find_if(parts().begin(), parts().end(), [&](const Part& part) { return part.name == name; });
    if (found == parts().end())
    {
      throw std::invalid_argument("no part that can be left out is called " + name);
    }
    found->remove(scene);
  }
  return scene;
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

std::string joined(const PartNames& names)
{
  return joined(std::vector<std::string>(names.begin(), names.end()), "+");
}

}  // namespace cloth
