#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cloth_sim/simulation/simulation.h"

#include "started_scene.h"

namespace cloth
{

/// How a scene is stepped.
struct Stepping
{
  std::string method;
  double time_step = 0.0;  ///< s
  double tolerance = 1e-3;
  int iterations = 10;
};

/// What came of a trial run.
struct Motion
{
  static constexpr double horizon = 1.0;  ///< s: that over which solver.tolerance is meant
  static constexpr int samples = 8;

  std::vector<Vectors> positions;  ///< m, at equal times up to the horizon; fewer where the run did not get there
  Simulation::Counters counters;
  double excess = 0.0;  ///< of the largest strain in `positions` above the strain limit, relative to it
};

/// The simulation of `scene` by these steps, which are shortened where the stability limit asks for it. Throws
/// SceneError.
Simulation simulation_of(const StartedScene& scene, const Stepping& stepping);

/// What steps took, in evaluations of the forces.
double evaluations_in(const Simulation::Counters& counters);

/// The motion up to the sample `samples`; cut off where it diverges, has taken more than `most_evaluations`, or a
/// sample makes it enough.
Motion motion_of(const StartedScene& scene, const Stepping& stepping, double most_evaluations,
                 int samples = Motion::samples, const std::function<bool(const Motion&)>& is_enough = {});

/// Root mean square over all nodes and the first so many samples, m; infinite where one of the two has fewer.
double distance(const Motion& one, const Motion& other, int samples = Motion::samples);

/// Below that over the whole horizon, m: of as many samples as both have.
double least_distance(const Motion& one, const Motion& other);

}  // namespace cloth
