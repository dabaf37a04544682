#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exact_motion.h"
#include "line_file.h"
#include "matrix_folder.h"
#include "matrix_rows.h"
#include "measurement.h"
#include "part.h"
#include "planned_run.h"
#include "progress.h"

namespace cloth
{

struct TrialSettings
{
  std::vector<double> tolerances{ 1e-2, 1e-3, 1e-4 };  ///< m
  double horizon = 1.0;                                ///< s
  double most_cost = 20.0;                             ///< a plan may run for so many times the best of the search
  double most_seconds = 60.0;  ///< of processor time, where no run of the search met the tolerance
  int runs = 5;                ///< of a plan, in turn with the best of the search; of a long one a single one
  double long_run = 2.0;       ///< s of processor time
  double least_timed = 0.02;   ///< s; shorter runs are made again until they come to this
  bool weighs_parts = true;
  MotionSettings motion;
};

/// A scene with its exact motion and what the search found.
struct SearchedScene
{
  MatrixScene scene;
  std::vector<ClothState> motion;
  std::vector<Measurement> rows;
};

/// Has the planner of this program plan every scene whose search is done, and holds its plans against what was found.
class PlanTrial
{
public:
  /// `build` tells programs apart: what another one planned stays in the folder, and is planned anew by this one.
  PlanTrial(const MatrixFolder& folder, const TrialSettings& settings, const Provenance& provenance,
            const std::string& build);

  /// Does all that is not there yet. False: there is no searched scene.
  bool run();

private:
  std::optional<SearchedScene> searched(const std::string& name) const;
  void run(const SearchedScene& searched, double tolerance);
  PlanRow tried(const SearchedScene& searched, double tolerance) const;
  void weigh_parts(const MatrixScene& scene, const PlanRow& row);
  /// The exact motion of the scene without some parts, from the folder or found now; empty: it cannot be had.
  std::vector<ClothState> motion_without(const MatrixScene& scene, const PartNames& names);

  const MatrixFolder& folder_;
  TrialSettings settings_;
  Provenance provenance_;
  std::string build_;
  LineFile plans_;
  LineFile parts_;
  Progress progress_;
};

}  // namespace cloth
