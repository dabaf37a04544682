#pragma once

#include <string>
#include <vector>

#include "journal.h"
#include "provenance.h"

namespace cloth
{

/// A row of scenes.csv.
struct SceneRow
{
  std::string scene;
  std::string kind;
  std::string fingerprint;
  bool accepted = false;
  double horizon = 0.0;          ///< s
  double reference_error = 0.0;  ///< m
  double growth = 0.0;           ///< of a disturbance of 1e-9 m; 0: not measured
  std::string reason;
  double tolerance = 0.0;  ///< m, that of the scene
};

/// Errors below so many times the reference's own are not told apart from it: such rows are not written.
constexpr double resolution = 100.0;

/// Writes scenes.csv and runs.csv into `folder`, each whole or not at all. A row of runs.csv is what all repeats of a
/// run have come to: errors of the first, the median, lowest and highest time. What the columns mean stands in
/// README.md beside this file.
void write_tables(const std::string& folder, const std::vector<SceneRow>& scenes, const Journal& journal,
                  const Provenance& provenance);

}  // namespace cloth
