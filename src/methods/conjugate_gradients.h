#pragma once

#include "cloth_sim/model/vectors.h"

namespace cloth
{

/// Scalar product of two sets of 3-vectors.
inline double dot(const Vectors& a, const Vectors& b)
{
  return a.cwiseProduct(b).sum();
}

/// Preconditions with the masses: z = M^-1 r.
class MassPreconditioner
{
public:
  explicit MassPreconditioner(const Eigen::VectorXd& masses) : masses_(masses)
  {
  }
  void operator()(const Vectors& r, Vectors& z) const
  {
    z = r.array().colwise() / masses_.array();
  }

private:
  const Eigen::VectorXd& masses_;
};

/// Conjugate gradients for A x = -r; A is known by its products alone.
class ConjugateGradients
{
public:
  static constexpr int most_iterations = 1000;

  /// Until what remains of r, measured with the inverse masses, is the part `part` of it. `multiply(u, product)` puts
  /// A u into `product`, `precondition(r, z)` B r into z, B being symmetric and close to the inverse of A. False: A or
  /// B is not positive definite, and x means nothing.
  template <typename Multiply, typename Precondition>
  bool solve(Multiply&& multiply, Precondition&& precondition, const Eigen::VectorXd& masses, const Vectors& r,
             double part, Vectors& x)
  {
    x.setZero(r.rows(), 3);
    remainder_ = -r;
    double left = squared_by_masses(masses);
    const double enough = part * part * left;
    double last = 1.0;
    for (iterations_ = 0; iterations_ < most_iterations && left > enough; ++iterations_)
    {
      precondition(remainder_, preconditioned_);
      const double squared = dot(remainder_, preconditioned_);
      if (!(squared > 0.0))
      {
        return false;
      }
      if (iterations_ == 0)
      {
        search_ = preconditioned_;
      }
      else
      {
        search_ = preconditioned_ + (squared / last) * search_;
      }
      last = squared;
      multiply(search_, product_);
      const double curvature = dot(search_, product_);
      if (!(curvature > 0.0))
      {
        return false;
      }
      const double length = squared / curvature;
      x += length * search_;
      remainder_ -= length * product_;
      left = squared_by_masses(masses);
    }
    return true;
  }

  /// Of the last solve.
  int iterations() const
  {
    return iterations_;
  }

private:
  double squared_by_masses(const Eigen::VectorXd& masses) const
  {
    return (remainder_.rowwise().squaredNorm().array() / masses.array()).sum();
  }

  Vectors remainder_;
  Vectors preconditioned_;
  Vectors search_;
  Vectors product_;
  int iterations_ = 0;
};

}  // namespace cloth
