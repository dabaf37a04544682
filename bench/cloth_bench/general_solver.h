#pragma once

#include "own_solver.h"

namespace cloth
{

/// A solver of ordinary differential equations that knows nothing of cloth, by its tolerance.
class GeneralSolver : public Solver
{
public:
  Setting setting() const override
  {
    return Setting::tolerance;
  }
  std::vector<double> ladder(const Problem&, double) const override
  {
    return tolerances();
  }
  std::string obstacle(const Problem& problem) const override
  {
    return problem.kind == Kind::limited ? "no differential equation has a strain limit" : "";
  }
};

}  // namespace cloth
