#pragma once

#include <functional>

#include "grid_laplacian.h"

namespace cloth
{

/// Conjugate gradients for H s = b within |s|_M <= radius, from s = 0. They end where the residual is small enough, at
/// the radius, or, on the radius too, along a direction whose curvature is not positive (Steihaug, "The conjugate
/// gradient method and trust regions in large scale optimization", 1983). M is the grid's Laplacian, which also
/// preconditions.
class SteihaugGradients
{
public:
  /// H u, for u that is zero at held nodes.
  using Product = std::function<void(const Vectors& u, Vectors& product)>;

  SteihaugGradients(Product hessian_product, const GridLaplacian& laplacian);

  /// `reduction` is the part of b, measured by M^-1, that counts as small enough. The number of products is limited.
  void solve(const Vectors& right_side, double radius, double reduction, int most_products);

  const Vectors& step() const
  {
    return step_;
  }
  /// s H s/2 - b s.
  double modelled_change() const
  {
    return modelled_change_;
  }
  bool at_radius() const
  {
    return at_radius_;
  }
  /// The last direction d, and its curvature d H d / d M d.
  const Vectors& direction() const
  {
    return direction_;
  }
  double curvature() const
  {
    return curvature_;
  }
  int products() const
  {
    return products_;
  }

private:
  void advance(double radius);
  /// |s + length d|_M^2
  double squared_after(double length) const;
  /// The length > 0 for which |s + length d|_M is the radius.
  double length_to(double radius) const;
  /// The next conjugate direction, and the products of step and direction by their recurrences.
  void turn(double length);

  Product hessian_product_;
  const GridLaplacian& laplacian_;
  Vectors step_;
  Vectors residual_;
  Vectors preconditioned_;
  Vectors direction_;
  Vectors product_;
  double squared_residual_ = 0.0;   ///< r M^-1 r
  double squared_step_ = 0.0;       ///< s M s
  double step_direction_ = 0.0;     ///< s M d
  double squared_direction_ = 0.0;  ///< d M d
  double curvature_ = 0.0;
  double modelled_change_ = 0.0;
  bool at_radius_ = false;
  int products_ = 0;
};

}  // namespace cloth
