#pragma once

#include "problem.h"

namespace cloth
{

/// A problem as a general solver of ordinary differential equations takes it: y' = f(t, y), y being the positions of
/// all nodes, x, y and z one after the other, and then their velocities likewise. Pinned nodes are put where they are
/// whenever the right-hand side is asked for; what becomes of their own unknowns has no effect on others.
class FirstOrderSystem
{
public:
  explicit FirstOrderSystem(const Problem& problem);

  long size() const
  {
    return 6L * state_.positions.rows();
  }
  void copy_start(double* y) const;
  /// f(t, y); both arrays have `size()` numbers.
  void find_slopes(double time, const double* y, double* slopes);
  ClothState state_at(double time, const double* y) const;
  /// Not finite, or with an energy that cannot be.
  bool has_diverged(double time, const double* y) const;

  long evaluations() const
  {
    return evaluations_;
  }

private:
  void take(double time, const double* y, ClothState& state) const;

  Simulation simulation_;
  DivergenceGuard guard_;
  ClothState state_;
  Vectors accelerations_;
  long evaluations_ = 0;
};

}  // namespace cloth
