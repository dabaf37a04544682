#pragma once

#include <Eigen/Core>

#include <geometry_msgs/Vector3Stamped.h>

#include "frames.h"

namespace cloth
{

/// The wind that a message of ~wind asks for: m/s, turned into the cloth's frame. Throws RefusedRequest where it is not
/// finite, faster than 1000 m/s, or its frame is not known.
Eigen::Vector3d wind_of(const geometry_msgs::Vector3Stamped& request, const Frames& frames);

}  // namespace cloth
