#pragma once

#include "general_solver.h"

namespace cloth
{

/// CVODE of SUNDIALS, by its tolerance, relative and absolute in m and m/s: Adams' formulae of orders 1 to 12 with
/// fixed-point iteration, or the backward differentiation formulae of orders 1 to 5 with Newton's method, GMRES without
/// a preconditioner and Jacobian products from differences.
class CvodeSolver : public GeneralSolver
{
public:
  enum class Formula
  {
    adams,
    bdf
  };

  explicit CvodeSolver(Formula formula) : formula_(formula)
  {
  }

  std::string name() const override
  {
    return formula_ == Formula::adams ? "cvode_adams" : "cvode_bdf";
  }
  Outcome run(const Problem& problem, double value, double most_seconds) const override;

private:
  Formula formula_;
};

}  // namespace cloth
