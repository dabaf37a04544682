#pragma once

#include "cloth_sim/scene/scene_params.h"
#include "cloth_sim/scene/scene_start.h"

namespace cloth
{

/// A scene, and its sheet at time 0.
struct StartedScene
{
  SceneParams params;
  SceneStart start;
};

/// The same sheet with cells `factor` times as long, as nearly as whole cells fill it, at least `fewest_nodes` a side
/// where it has so many: the start is interpolated, pins name the nearest nodes.
StartedScene coarser(const StartedScene& scene, int factor, int fewest_nodes);

/// The same sheet with `factor` times as many cells a side, all corners of its cells being nodes again; otherwise as
/// above.
StartedScene finer(const StartedScene& scene, int factor);

/// The places of the nodes of a grid of rows x cols nodes on another one with values `on_other` (a row a node), by
/// bilinear interpolation.
Vectors interpolated(const Vectors& on_other, int other_rows, int other_cols, int rows, int cols);

}  // namespace cloth
