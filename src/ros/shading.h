#pragma once

#include <Eigen/Core>

namespace cloth
{

/// The colour that a matt cloth shows where its unit normal is `normal`, in a frame with z up: a warm key light, a
/// cooler fill light from the other side, and light from all around. A surface and its back look the same, so that
/// neither is ever black. Red, green and blue in [0, 1]. `normal` may be zero.
Eigen::Vector3d lit(const Eigen::Vector3d& colour, const Eigen::Vector3d& normal);

/// The same, of less contrast: for colours that are to be read.
Eigen::Vector3d softly_lit(const Eigen::Vector3d& colour, const Eigen::Vector3d& normal);

/// The colour of a strain, from unstretched (blue) over green and yellow to `full_scale` and beyond (red).
/// `full_scale` > 0.
Eigen::Vector3d strain_colour(double strain, double full_scale);

}  // namespace cloth
