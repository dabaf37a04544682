#pragma once

#include "general_solver.h"

namespace cloth
{

/// Boost.odeint by its tolerance, relative and absolute in m and m/s: the formula of Dormand and Prince of order 5, or
/// Fehlberg's of order 8.
class OdeintSolver : public GeneralSolver
{
public:
  enum class Formula
  {
    dopri5,
    fehlberg78
  };

  explicit OdeintSolver(Formula formula) : formula_(formula)
  {
  }

  std::string name() const override
  {
    return formula_ == Formula::dopri5 ? "odeint_dopri5" : "odeint_fehlberg78";
  }
  Outcome run(const Problem& problem, double value, double most_seconds) const override;

private:
  Formula formula_;
};

}  // namespace cloth
