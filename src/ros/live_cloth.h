#pragma once

#include "cloth_sim/scene/plan.h"
#include "cloth_sim/simulation/simulation.h"

#include "mesh_marker.h"
#include "pin_attachments.h"
#include "pin_markers.h"
#include "spring_marker.h"
#include "wind_time_out.h"

namespace cloth
{

/// A scene brought to life: its simulation, and the markers that show it.
struct LiveCloth
{
  /// Throws what `make_plan`, `plan_from_recording` and `build_simulation` throw.
  explicit LiveCloth(const SceneParams& given);
  /// The same cloth with the live keys of `next`: its state carries on. Wind that a message has set stays unless
  /// air.wind changes. Throws what `live_plan` and `carry_on` throw.
  LiveCloth(const LiveCloth& running, const SceneParams& next);
  LiveCloth(const LiveCloth&) = delete;  // the markers refer to the simulation's model
  LiveCloth& operator=(const LiveCloth&) = delete;

  /// Back to time 0, with wind as the scene has it, and pins as the scene or the recording has them.
  void restart();

  SceneParams scene;  ///< as it is in force: with the pins of a recorded start, a step that is not stable lowered
  Plan plan;
  Simulation simulation;
  MeshMarker mesh;
  SpringMarker springs;
  PinMarkers pins;
  PinAttachments attachments;
  WindTimeOut wind_time_out;
};

}  // namespace cloth
