#pragma once

#include <vector>

#include <Eigen/Core>

#include "cloth_sim/model/cloth_model.h"
#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// Whether any two of the nodes are nearer to each other at `positions` (m) than in the sheet at rest.
bool has_slack(const ClothModel& model, const std::vector<int>& nodes, const Vectors& positions);

/// The sheet hung in catenaries from its pinned nodes, which stay where `start_state` has them: m, one row a node;
/// `down` is the unit vector along gravity. After Jerry Weil, "The synthesis of cloth objects", SIGGRAPH 1986:
///
/// 1. between every two pinned nodes a catenary as long as they are apart in the sheet at rest, along the line of the
///    grid that joins them; of two curves through a node the higher stays;
/// 2. between the nodes placed so far, along rows and columns, the same;
/// 3. all other nodes straight below the node of the grid that is nearest of those placed, as far as it is in the
///    sheet at rest.
///
/// The ripple is added to the free nodes in the end.
Vectors hung_in_catenaries(const StartParams& start, const ClothModel& model, const std::vector<int>& pinned,
                           const Eigen::Vector3d& down);

}  // namespace cloth
