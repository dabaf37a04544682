#include "scene_display.h"

#include "cloth_sim/scene/start_state.h"

namespace cloth
{
namespace
{

MeshColouring colouring_of(const SceneParams& scene)
{
  return { scene.node.fabric_colour, scene.node.colouring == "strain", scene.strain_limit.max_strain };
}

/// The direction of a chain's width at the start.
Eigen::Vector3d across_chain(const ClothModel& model, const SceneParams& scene)
{
  const Eigen::Vector3d at_rest = model.cols == 1 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  return rotation_of(scene.start.rpy) * at_rest;
}

}  // namespace

MeshMarker mesh_marker_of(const ClothModel& model, const std::string& frame_id, const SceneParams& scene)
{
  return MeshMarker(model, frame_id, colouring_of(scene), across_chain(model, scene));
}

}  // namespace cloth
