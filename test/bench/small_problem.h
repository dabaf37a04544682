#pragma once

#include <string>

#include "own_solver.h"
#include "problem.h"
#include "scene/scene_text.h"

namespace cloth
{

/// A small damped sheet that swings, in a YAML file of its own.
inline const char* const small_scene =
    "cloth: {rows: 5, cols: 6, ripple: 0.02}\n"
    "springs: {structural: {stiffness: 100, damping: 0.05}, shear: {stiffness: 100, damping: 0.05}}\n"
    "strain_limit: {max_strain: 0}\n";

inline Problem small_problem(double horizon = 0.1)
{
  return problem_of("small", Kind::trajectory, scene_of(small_scene), horizon);
}

/// As exact as it gets.
inline Outcome exact_motion(const Problem& problem)
{
  return OwnSolver(*find_method("dopri5"), Setting::tolerance).run(problem, 1e-13, 100.0);
}

/// The exact motion with every node put beside where it should be: by the setting, in m, a direction for each node. It
/// counts its runs.
class StraySolver : public Solver
{
public:
  explicit StraySolver(int* runs = nullptr) : runs_(runs)
  {
  }
  std::string name() const override
  {
    return "stray";
  }
  Setting setting() const override
  {
    return Setting::step;
  }
  std::vector<double> ladder(const Problem&, double) const override
  {
    return { 1e-2, 5e-4, 1e-5 };
  }
  Outcome run(const Problem& problem, double value, double) const override
  {
    if (runs_ != nullptr)
    {
      ++*runs_;
    }
    Outcome outcome = exact_motion(problem);
    for (ClothState& sample : outcome.samples)
    {
      for (int i = 0; i < sample.positions.rows(); ++i)
      {
        sample.positions.row(i) += value * Eigen::RowVector3d(std::cos(i), std::sin(i) * 0.6, std::sin(i) * 0.8);
      }
    }
    return outcome;
  }

private:
  int* runs_;
};

}  // namespace cloth
