#pragma once

#include "cloth_sim/model/cloth_model.h"
#include "cloth_sim/model/cloth_state.h"
#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// The rotation of roll, pitch and yaw (rad): about fixed x, then y, then z.
Eigen::Matrix3d rotation_of(const Eigen::Vector3d& rpy);

/// Where the nodes of `model` are and how they move at time 0: the sheet at rest, stretched, rippled along its normal,
/// turned by rpy (`rotation_of`) and moved to its position. At fractions a across and b down the
/// ripple is A (sin(2 pi a + 0.3) + 0.5 sin(3 pi b + 1.1)) b.
ClothState start_state(const StartParams& start, const ClothModel& model);

}  // namespace cloth
