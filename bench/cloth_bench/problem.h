#pragma once

#include <string>
#include <vector>

#include "cloth_sim/model/cloth_state.h"
#include "cloth_sim/scene/plan.h"

namespace cloth
{

/// What is held against what.
enum class Kind
{
  trajectory,  ///< the springs' and the air's equations, no strain limit: solvers against a converged reference
  limited,     ///< with the strain limit after every step, against the same rule at h -> 0
  spatial      ///< a coarse grid against a finer one
};

const char* name_of(Kind kind);

/// A motion to be found: equations and start, and the times at which positions are compared.
struct Problem
{
  static constexpr int samples = 8;  ///< equally spaced, the last one at the horizon

  std::string scene;  ///< its name
  Kind kind = Kind::trajectory;
  Plan plan;             ///< its method and the method's settings count for nothing
  double horizon = 0.0;  ///< s

  double sample_interval() const
  {
    return horizon / samples;
  }
  double time_of(int sample) const
  {
    return sample + 1 == samples ? horizon : (sample + 1) * sample_interval();
  }
};

/// The problem of a scene over `horizon` (s). The start has no symmetry that could hide errors: a flat one without
/// `cloth.ripple`, and any that is not flat, gets a smooth asymmetric displacement of 1 % of the sheet's shorter side
/// along its normal at rest, pins along with it. A problem of the kind trajectory has no strain limit.
Problem problem_of(const std::string& name, Kind kind, SceneParams scene, double horizon);

/// The same that starts with another smooth displacement, of `size` (m) as a root mean square.
Problem disturbed(Problem problem, double size);

/// The longest of 0.5, 0.25, 0.1, 0.05, ... s, no longer than `longest`, over which velocity_verlet at its stability
/// limit moves `most_node_steps` nodes a step at most, steps added up. It follows from the scene alone.
double horizon_of(const SceneParams& scene, double longest, double most_node_steps);

/// The simulation of a problem by the method of that name; step (s), tolerance (m) and iterations as they apply.
Simulation simulation_of(const Problem& problem, const std::string& method, double time_step,
                         const MethodSettings& settings);

}  // namespace cloth
