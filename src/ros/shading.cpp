#include "shading.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cloth
{
namespace
{

struct Light
{
  Eigen::Vector3d towards;  ///< unit vector
  Eigen::Vector3d colour;
};

// Both lights stand well to one side of a sheet that hangs in the x-z plane: folds turn normals about the vertical, and
// only light from the side tells one flank of a fold from the other.
const Light key{ Eigen::Vector3d(0.55, 0.60, 0.58).normalized(), { 0.86, 0.83, 0.77 } };
const Light fill{ Eigen::Vector3d(-0.80, 0.50, 0.30).normalized(), { 0.20, 0.23, 0.29 } };
const Eigen::Vector3d from_all_around(0.22, 0.22, 0.25);

/// Lambert's cosine law for both sides of a thin sheet, rounded where a side turns away from the light, so that no
/// black line is drawn there.
double brightness(const Eigen::Vector3d& normal, const Light& light)
{
  constexpr double roundness = 0.12;
  const double cosine = normal.dot(light.towards);
  return std::sqrt(cosine * cosine + roundness * roundness);
}

Eigen::Vector3d illumination(const Eigen::Vector3d& normal)
{
  return from_all_around + brightness(normal, key) * key.colour + brightness(normal, fill) * fill.colour;
}

Eigen::Vector3d displayable(const Eigen::Vector3d& colour)
{
  return colour.cwiseMax(0.0).cwiseMin(1.0);
}

const std::array<Eigen::Vector3d, 4> strain_stops{ {
    { 0.16, 0.32, 0.75 },
    { 0.10, 0.68, 0.55 },
    { 0.98, 0.84, 0.22 },
    { 0.86, 0.12, 0.14 },
} };

}  // namespace

Eigen::Vector3d lit(const Eigen::Vector3d& colour, const Eigen::Vector3d& normal)
{
  return displayable(colour.cwiseProduct(illumination(normal)));
}

Eigen::Vector3d softly_lit(const Eigen::Vector3d& colour, const Eigen::Vector3d& normal)
{
  constexpr double contrast = 0.5;
  return displayable(colour * (1.0 - contrast + contrast * illumination(normal).mean()));
}

Eigen::Vector3d strain_colour(double strain, double full_scale)
{
  constexpr int last = static_cast<int>(strain_stops.size()) - 1;
  const double place = std::clamp(strain / full_scale, 0.0, 1.0) * last;
  const int stop = std::min(static_cast<int>(place), last - 1);
  const double part = place - stop;
  return (1.0 - part) * strain_stops[static_cast<size_t>(stop)] + part * strain_stops[static_cast<size_t>(stop) + 1];
}

}  // namespace cloth
