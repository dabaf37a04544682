#pragma once

#include <map>
#include <string>

#include "pilot.h"

namespace cloth
{

/// What steps cost on this machine, measured once and kept in a file, so that the same scene is planned the same again.
class StepCosts
{
public:
  /// Reads what is kept in `path`; empty: nothing is kept. A file that cannot be read counts as none.
  explicit StepCosts(std::string path);

  /// Where costs of this machine and build are kept: below $XDG_CACHE_HOME, or $HOME/.cache. Empty: neither is set.
  static std::string usual_path();

  /// Seconds of processor time that a step takes, on average over the first ones of `scene`. Measured against steps of
  /// velocity_verlet in turn: a machine that others use too is slower for seconds at a time. Throws SceneError.
  double of_a_step(const StartedScene& scene, const Stepping& stepping);

  /// Of one of its evaluations of the forces, with what the step does besides; the passes of a strain limit are none.
  double of_an_evaluation(StartedScene scene, const Stepping& stepping);

private:
  void keep();

  std::string path_;
  std::map<std::string, double> seconds_;  ///< by what `key_of` says
};

}  // namespace cloth
