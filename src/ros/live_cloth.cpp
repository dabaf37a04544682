#include "live_cloth.h"

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
Eigen::Vector3d across_chain(const SceneParams& scene)
{
  const Eigen::Vector3d at_rest = scene.sheet.cols == 1 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  return rotation_of(scene.start.rpy) * at_rest;
}

}  // namespace

LiveCloth::LiveCloth(const SceneParams& scene)
  : plan(make_plan(scene))
  , simulation(build_simulation(plan))
  , mesh(simulation.model(), plan.scene.frame_id, colouring_of(plan.scene), across_chain(plan.scene))
  , springs(simulation.model(), plan.scene.frame_id)
  , pins(simulation.model(), plan.scene.frame_id)
{
}

void LiveCloth::restart()
{
  simulation = build_simulation(plan);
}

}  // namespace cloth
