#include "cloth_sim/scene/catenary.h"

#include <cmath>

namespace cloth
{
namespace
{

/// Less slack than this, as a part of the length, is rounding.
constexpr double least_slack = 1e-12;
/// A span below this part of the length leaves no room for an arc.
constexpr double least_span = 1e-9;

/// The z > 0 with sinh(z)/z = ratio > 1, by Newton's method; sinh(z) - ratio z is convex, so that it converges from
/// any start right of its least value.
double half_width_of(double ratio)
{
  double z = ratio < 3.0 ? std::sqrt(6.0 * (ratio - 1.0)) : std::log(2.0 * ratio) + std::log(std::log(2.0 * ratio));
  for (int iteration = 0; iteration < 50; ++iteration)
  {
    const double correction = (std::sinh(z) - ratio * z) / (std::cosh(z) - ratio);
    z -= correction;
    if (std::abs(correction) <= 1e-15 * z)
    {
      break;
    }
  }
  return z;
}

}  // namespace

Catenary::Catenary(const Eigen::Vector3d& start, const Eigen::Vector3d& end, double length, const Eigen::Vector3d& down)
  : start_(start), way_(end - start), down_(down), length_(length)
{
  is_taut_ = way_.norm() >= length * (1.0 - least_slack);
  if (is_taut_)
  {
    return;
  }
  const double drop = way_.dot(down);
  const Eigen::Vector3d across = way_ - drop * down;
  const double span = across.norm();
  if (span < least_span * length)
  {
    first_arc_ = -0.5 * (length + drop);
    return;
  }
  level_ = across / span;
  const double z = half_width_of(std::sqrt((length - drop) * (length + drop)) / span);
  scale_ = 0.5 * span / z;
  first_arc_ = -scale_ * std::sinh(z + std::atanh(drop / length));
}

Eigen::Vector3d Catenary::at(double arc) const
{
  if (is_taut_)
  {
    return start_ + arc / length_ * way_;
  }
  const double here = first_arc_ + arc;
  const double risen = std::hypot(scale_, here) - std::hypot(scale_, first_arc_);
  const double along = scale_ > 0.0 ? scale_ * (std::asinh(here / scale_) - std::asinh(first_arc_ / scale_)) : 0.0;
  return start_ + along * level_ - risen * down_;
}

}  // namespace cloth
