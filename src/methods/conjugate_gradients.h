#pragma once

#include "cloth_sim/model/vectors.h"

namespace cloth
{

/// Scalar product of two sets of 3-vectors.
inline double dot(const Vectors& a, const Vectors& b)
{
  return a.cwiseProduct(b).sum();
}

/// Conjugate gradients for A x = -r, preconditioned with the masses; A is known by its products alone.
class ConjugateGradients
{
public:
  static constexpr int most_iterations = 1000;

  /// Until what remains of r, measured with the inverse masses, is the part `part` of it. `multiply(u, product)` puts
  /// A u into `product`. False: A is not positive definite, and x means nothing.
  template <typename Multiply>
  bool solve(Multiply&& multiply, const Eigen::VectorXd& masses, const Vectors& r, double part, Vectors& x)
  {
    x.setZero(r.rows(), 3);
    remainder_ = -r;
    preconditioned_ = remainder_.array().colwise() / masses.array();
    search_ = preconditioned_;
    double squared = dot(remainder_, preconditioned_);
    const double enough = part * part * squared;
    for (iterations_ = 0; iterations_ < most_iterations && squared > enough; ++iterations_)
    {
      multiply(search_, product_);
      const double curvature = dot(search_, product_);
      if (!(curvature > 0.0))
      {
        return false;
      }
      const double length = squared / curvature;
      x += length * search_;
      remainder_ -= length * product_;
      preconditioned_ = remainder_.array().colwise() / masses.array();
      const double next = dot(remainder_, preconditioned_);
      search_ = preconditioned_ + (next / squared) * search_;
      squared = next;
    }
    return true;
  }

  /// Of the last solve.
  int iterations() const
  {
    return iterations_;
  }

private:
  Vectors remainder_;
  Vectors preconditioned_;
  Vectors search_;
  Vectors product_;
  int iterations_ = 0;
};

}  // namespace cloth
