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
  /// Throws what `make_plan` and `build_simulation` throw.
  explicit LiveCloth(const SceneParams& scene);
  LiveCloth(const LiveCloth&) = delete;  // the markers refer to the simulation's model
  LiveCloth& operator=(const LiveCloth&) = delete;

  /// Back to time 0, with pins and wind as the scene has them.
  void restart();

  Plan plan;
  Simulation simulation;
  MeshMarker mesh;
  SpringMarker springs;
  PinMarkers pins;
  PinAttachments attachments;
  WindTimeOut wind_time_out;
};

}  // namespace cloth
