#pragma once

#include "solver.h"

namespace cloth
{

/// A method of the table in a simulation, as a user runs it, on one thread.
class OwnSolver : public Solver
{
public:
  /// `setting`: step, or tolerance of a method that chooses its steps, or iterations at a fixed step of 1/240 s or
  /// less.
  OwnSolver(const MethodRow& row, Setting setting) : row_(row), setting_(setting)
  {
  }

  std::string name() const override
  {
    return row_.name;
  }
  Setting setting() const override
  {
    return setting_;
  }
  std::vector<double> ladder(const Problem& problem, double ratio) const override;
  Outcome run(const Problem& problem, double value, double most_seconds) const override;

private:
  const MethodRow& row_;
  Setting setting_;
};

/// Takes a simulation at time 0 through the problem's times; gives up as too slow after about `most_seconds` of
/// processor time.
Outcome outcome_of(Simulation& simulation, const Problem& problem, double most_seconds);

/// Every method of the table by its step, or by its tolerance where it is adaptive; projective by its iterations too.
Solvers own_solvers();

/// 0.1, 0.01, ... 1e-12 (m).
std::vector<double> tolerances();

}  // namespace cloth
