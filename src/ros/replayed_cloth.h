#pragma once

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothTopology.h"
#include "cloth_sim/scene/scene_params.h"

#include "mesh_marker.h"
#include "pin_markers.h"
#include "spring_marker.h"

namespace cloth
{

/// A recorded cloth of one topology, and the markers that show it.
struct ReplayedCloth
{
  /// `scene` tells how to draw it. Throws what `recorded_model` throws.
  ReplayedCloth(const cloth_sim::ClothTopology::ConstPtr& topology, const SceneParams& scene);
  ReplayedCloth(const ReplayedCloth&) = delete;  // the markers refer to the model
  ReplayedCloth& operator=(const ReplayedCloth&) = delete;

  /// Takes over the positions and pins of `state`. Throws RefusedRequest where its size does not fit, or a position is
  /// not finite.
  void take(const cloth_sim::ClothState& state);

  /// The next pin markers will tell of all pins, even where nothing changed.
  void forget_shown_pins();

  cloth_sim::ClothTopology::ConstPtr topology;
  ClothModel model;
  Vectors positions;
  std::vector<Pin> held;  ///< one pin of all held nodes, because a state does not tell them apart; empty: none
  MeshMarker mesh;
  SpringMarker springs;
  PinMarkers pins;
};

}  // namespace cloth
