#pragma once

#include "cloth_sim/model/cloth_model.h"
#include "cloth_sim/model/cloth_state.h"
#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// The rotation of roll, pitch and yaw (rad): about fixed x, then y, then z.
Eigen::Matrix3d rotation_of(const Eigen::Vector3d& rpy);

/// How far each node is displaced along the sheet's normal at time 0, m: at fractions a across and b down
/// A (sin(2 pi a + 0.3) + 0.5 sin(3 pi b + 1.1)) b, A the scene's ripple.
Eigen::VectorXd ripple_of(const StartParams& start, const ClothModel& model);

/// Where the nodes of `model` are and how they move at time 0 where the sheet starts flat: the sheet at rest,
/// stretched, rippled along its normal (`ripple_of`), turned by rpy (`rotation_of`) and moved to its position.
ClothState start_state(const StartParams& start, const ClothModel& model);

}  // namespace cloth
