#include "steihaug_gradients.h"

#include <cmath>
#include <utility>

namespace cloth
{
namespace
{

double inner(const Vectors& one, const Vectors& other)
{
  return one.cwiseProduct(other).sum();
}

}  // namespace

SteihaugGradients::SteihaugGradients(Product hessian_product, const GridLaplacian& laplacian)
  : hessian_product_(std::move(hessian_product)), laplacian_(laplacian)
{
}

void SteihaugGradients::solve(const Vectors& right_side, double radius, double reduction, int most_products)
{
  step_.setZero(right_side.rows(), 3);
  residual_ = right_side;
  laplacian_.solve(residual_, preconditioned_);
  direction_ = preconditioned_;
  squared_residual_ = inner(residual_, preconditioned_);
  squared_direction_ = squared_residual_;
  squared_step_ = 0.0;
  step_direction_ = 0.0;
  at_radius_ = false;
  products_ = 0;
  const double enough = squared_residual_ * reduction * reduction;
  while (!at_radius_ && products_ < most_products && squared_residual_ > enough)
  {
    advance(radius);
  }
  modelled_change_ = -0.5 * (inner(right_side, step_) + inner(residual_, step_));
}

void SteihaugGradients::advance(double radius)
{
  hessian_product_(direction_, product_);
  ++products_;
  const double bend = inner(direction_, product_);
  curvature_ = bend / squared_direction_;
  double length = squared_residual_ / bend;
  at_radius_ = bend <= 0.0 || squared_after(length) >= radius * radius;
  if (at_radius_)
  {
    length = length_to(radius);
  }
  step_ += length * direction_;
  residual_ -= length * product_;
  if (!at_radius_)
  {
    turn(length);
  }
}

double SteihaugGradients::squared_after(double length) const
{
  return squared_step_ + length * (2.0 * step_direction_ + length * squared_direction_);
}

double SteihaugGradients::length_to(double radius) const
{
  const double missing = radius * radius - squared_step_;
  const double root = std::sqrt(step_direction_ * step_direction_ + squared_direction_ * missing);
  return missing / (root + step_direction_);
}

void SteihaugGradients::turn(double length)
{
  squared_step_ = squared_after(length);
  laplacian_.solve(residual_, preconditioned_);
  const double squared_before = squared_residual_;
  squared_residual_ = inner(residual_, preconditioned_);
  const double ratio = squared_residual_ / squared_before;
  direction_ = preconditioned_ + ratio * direction_;
  step_direction_ = ratio * (step_direction_ + length * squared_direction_);
  squared_direction_ = squared_residual_ + ratio * ratio * squared_direction_;
}

}  // namespace cloth
