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

constexpr Belief believed{ 0.25, 2.0 };
/// Flex springs bend longer cells with more force.
constexpr Belief believed_of_flex{ 0.25, 8.0 };
/// Damping keeps down short waves, of which longer cells have none.
constexpr Belief believed_of_damping{ 0.0, 2.0 };

bool is_among(const ModelPart& part, const PartList& names)
{
  return std::find(names.begin(), names.end(), part.name) != names.end();
}

}  // namespace

const std::vector<ModelPart>& optional_parts()
{
  static const std::vector<ModelPart> parts{
    { "wind", believed,
      [](const SceneParams& scene) {
        return scene.air.wind_coupling > 0.0 && scene.sheet.rows > 1 && scene.sheet.cols > 1;
      },
      [](SceneParams& scene) { scene.air.wind_coupling = 0.0; } },
    { "flex springs", believed_of_flex,
      [](const SceneParams& scene) {
        return scene.sheet.flex.stiffness > 0.0 && std::max(scene.sheet.rows, scene.sheet.cols) > 2;
      },
      [](SceneParams& scene) {
        scene.sheet.flex = { 0.0, 0.0 };
      } },
    { "shear springs", believed,
      [](const SceneParams& scene) {
        return scene.sheet.shear.stiffness > 0.0 && std::min(scene.sheet.rows, scene.sheet.cols) > 1;
      },
      [](SceneParams& scene) {
        scene.sheet.shear = { 0.0, 0.0 };
      } },
    { "internal damping", believed_of_damping,
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

Belief belief_in_a_coarser_grid(const PartList& names)
{
  Belief belief = believed;
  for (const ModelPart& part : optional_parts())
  {
    if (is_among(part, names))
    {
      belief = { std::min(belief.less, part.belief.less), std::max(belief.more, part.belief.more) };
    }
  }
  return belief;
}

SceneParams without(SceneParams scene, const PartList& names)
{
  for (const ModelPart& part : optional_parts())
  {
    if (is_among(part, names))
    {
      part.take_out(scene);
    }
  }
  return scene;
}

}  // namespace cloth
