#include "model_parts.h"

#include <algorithm>

namespace cloth
{
namespace
{

bool is_damped(const SpringProperties& springs)
{
  return springs.stiffness > 0.0 && springs.damping > 0.0;
}

}  // namespace

const char* const internal_damping = "internal damping";

const std::vector<ModelPart>& optional_parts()
{
  static const std::vector<ModelPart> parts{
    { "wind",
      [](const SceneParams& scene) {
        return scene.air.wind_coupling > 0.0 && scene.sheet.rows > 1 && scene.sheet.cols > 1;
      },
      [](SceneParams& scene) { scene.air.wind_coupling = 0.0; } },
    { "flex springs",
      [](const SceneParams& scene) {
        return scene.sheet.flex.stiffness > 0.0 && std::max(scene.sheet.rows, scene.sheet.cols) > 2;
      },
      [](SceneParams& scene) {
        scene.sheet.flex = { 0.0, 0.0 };
      } },
    { "shear springs",
      [](const SceneParams& scene) {
        return scene.sheet.shear.stiffness > 0.0 && std::min(scene.sheet.rows, scene.sheet.cols) > 1;
      },
      [](SceneParams& scene) {
        scene.sheet.shear = { 0.0, 0.0 };
      } },
    { internal_damping,
      [](const SceneParams& scene) {
        return is_damped(scene.sheet.structural) || is_damped(scene.sheet.shear) || is_damped(scene.sheet.flex);
      },
      [](SceneParams& scene) {
        for (SpringProperties* springs : { &scene.sheet.structural, &scene.sheet.shear, &scene.sheet.flex })
        {
          springs->damping = 0.0;
        }
      } },
  };
  return parts;
}

SceneParams without(SceneParams scene, const PartList& names)
{
  for (const ModelPart& part : optional_parts())
  {
    if (std::find(names.begin(), names.end(), part.name) != names.end())
    {
      part.take_out(scene);
    }
  }
  return scene;
}

}  // namespace cloth
