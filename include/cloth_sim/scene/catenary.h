#pragma once

#include <Eigen/Core>

namespace cloth
{

/// The curve in which an inextensible uniform chain of a given length hangs between two points (Jakob Bernoulli's
/// problem of 1690): x = a asinh(s/a), height = sqrt(a^2 + s^2), s the arc length from the lowest point. Where the
/// chain is no longer than the way between its ends it is a straight line, evenly stretched; where one end hangs
/// plumb below the other, a line down and up again.
class Catenary
{
public:
  /// From `start` to `end` (m), `length` in m, `down` the unit vector along gravity.
  Catenary(const Eigen::Vector3d& start, const Eigen::Vector3d& end, double length, const Eigen::Vector3d& down);

  /// The point at an arc length from the start, 0 to `length`, m.
  Eigen::Vector3d at(double arc) const;

private:
  Eigen::Vector3d start_;
  Eigen::Vector3d way_;  ///< from start to end
  Eigen::Vector3d down_;
  double length_;
  bool is_taut_ = true;
  Eigen::Vector3d level_ = Eigen::Vector3d::Zero();  ///< unit vector across gravity towards the end
  double scale_ = 0.0;                               ///< a; 0 for a line down and up again
  double first_arc_ = 0.0;                           ///< of the start, from the lowest point; negative before it
};

}  // namespace cloth
