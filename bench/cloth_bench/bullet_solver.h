#pragma once

#include "solver.h"

namespace cloth
{

/// Bullet's soft body as it is used for cloth, by its step, ten iterations each. Its springs are rods, whatever their
/// stiffness, and it reckons in single precision: it comes near to stiff sheets alone. The air's drag acts as Bullet
/// has it, a part of the velocity each step.
class BulletSolver : public Solver
{
public:
  std::string name() const override
  {
    return "bullet";
  }
  Setting setting() const override
  {
    return Setting::step;
  }
  std::vector<double> ladder(const Problem& problem, double ratio) const override;
  Outcome run(const Problem& problem, double value, double most_seconds) const override;
  std::string obstacle(const Problem& problem) const override;
};

}  // namespace cloth
