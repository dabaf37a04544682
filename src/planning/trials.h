#pragma once

#include <map>
#include <string>
#include <vector>

#include "pilot.h"
#include "started_scene.h"
#include "step_costs.h"

namespace cloth
{

/// The method that finds out: no other explicit one is as cheap for its order.
extern const char* const scout;

/// All trial runs of a scene, on a coarser grid where that is cheaper.
class Trials
{
public:
  /// Throws SceneError where the scene cannot be stepped.
  Trials(const StartedScene& scene, StepCosts& costs);

  /// Parts are tried only where that costs less than they may save in a run or two.
  bool is_coarser() const;

  /// How much longer the cells are than the scene's.
  double coarseness() const;

  /// The scout's longest step on the coarser grid, s.
  double longest_step() const
  {
    return longest_step_;
  }

  /// By what factor the scout errs more on the sheet itself than on the coarser grid, early on and with the same steps.
  double grid_allowance();

  /// By how much the answer changes without these parts, m; infinite where they are all that keeps it together.
  double change_without(const std::vector<std::string>& parts);

  /// The parts that the scene still has.
  const SceneParams& params() const
  {
    return scene_.params;
  }

  /// From now on all runs are without these parts.
  void leave_out(const std::vector<std::string>& parts);

  /// The motion on the coarser grid.
  const Motion& motion(const Stepping& stepping);

  /// What all trials may cost is used up: a tenth of what the scout makes of ten seconds, in work done on nodes, so
  /// that the same scene is planned alike whatever else the machine does.
  bool are_over() const
  {
    return work_ > most_work_;
  }

private:
  Motion run(const StartedScene& scene, const Stepping& stepping, int samples = Motion::samples);

  StartedScene scene_;
  StepCosts& costs_;
  StartedScene pilot_;
  double longest_step_;
  double most_work_;
  double work_ = 0.0;
  std::map<std::string, Motion> motions_;
};

}  // namespace cloth
