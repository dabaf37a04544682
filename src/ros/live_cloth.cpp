#include "live_cloth.h"

#include "scene_display.h"

namespace cloth
{

LiveCloth::LiveCloth(const SceneParams& scene)
  : plan(make_plan(scene))
  , simulation(build_simulation(plan))
  , mesh(mesh_marker_of(simulation.model(), plan.scene.frame_id, plan.scene))
  , springs(simulation.model(), plan.scene.frame_id)
  , pins(simulation.model(), plan.scene.frame_id)
  , attachments(plan.scene.node.tf_pins)
  , wind_time_out(plan.scene.node.wind_timeout)
{
}

void LiveCloth::restart()
{
  simulation = build_simulation(plan);
  attachments.clear();
  wind_time_out = WindTimeOut(plan.scene.node.wind_timeout);
}

}  // namespace cloth
