#include "live_cloth.h"

#include "recorded_start.h"
#include "scene_display.h"

namespace cloth
{
namespace
{

/// `running` going over to `plan`.
Simulation simulation_with(const Plan& plan, const LiveCloth& running)
{
  Simulation simulation = carry_on(plan, running.simulation);
  if (plan.scene.air.wind == running.scene.air.wind)
  {
    simulation.set_wind(running.simulation.dynamics().air().properties().wind);
  }
  return simulation;
}

/// Pins are no live keys: those of a recording stay, which the scene does not have.
SceneParams with_pins_of(const LiveCloth& running, SceneParams next)
{
  next.pins = running.scene.pins;
  return next;
}

Plan plan_of(const SceneParams& scene)
{
  return scene.node.start_bag.empty() ? make_plan(scene) : plan_from_recording(scene);
}

}  // namespace

LiveCloth::LiveCloth(const SceneParams& given)
  : scene(given)
  , plan(plan_of(scene))
  , simulation(build_simulation(plan))
  , mesh(mesh_marker_of(simulation.model(), plan.scene.frame_id, plan.scene))
  , springs(simulation.model(), plan.scene.frame_id)
  , pins(simulation.model(), plan.scene.frame_id)
  , attachments(plan.scene.node.tf_pins)
  , wind_time_out(plan.scene.node.wind_timeout)
{
  scene.pins = plan.scene.pins;
}

LiveCloth::LiveCloth(const LiveCloth& running, const SceneParams& next)
  : scene(with_pins_of(running, next))
  , plan(live_plan(running.plan, scene))
  , simulation(simulation_with(plan, running))
  , mesh(mesh_marker_of(simulation.model(), plan.scene.frame_id, plan.scene))
  , springs(simulation.model(), plan.scene.frame_id)
  , pins(running.pins)
  , attachments(running.attachments)
  , wind_time_out(running.wind_time_out)
{
  const double given = scene.solver.time_step;
  if (!simulation.method().is_adaptive && given > simulation.time_step())
  {
    scene.solver.time_step = plan.scene.solver.time_step = simulation.time_step();
    simulation = simulation_with(plan, running);  // whose step then stays below, also where the limit grows again
  }
}

void LiveCloth::restart()
{
  simulation = build_simulation(plan);
  attachments.clear();
  wind_time_out = WindTimeOut(plan.scene.node.wind_timeout);
}

}  // namespace cloth
