#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drawn_scene.h"
#include "exact_motion.h"
#include "journal.h"
#include "matrix_folder.h"
#include "progress.h"
#include "search.h"

namespace cloth
{

/// Which scenes there are, and how much is done about them.
struct MatrixSettings
{
  std::uint64_t development_seed = 1;
  std::uint64_t held_out_seed = 7;  ///< another one where the half has been looked at
  int scenes = 60;
  int most_per_side = 96;        ///< nodes
  double horizon = 1.0;          ///< s
  double most_node_steps = 1e8;  ///< nodes moved by velocity_verlet at its limit; beyond it no reference is tried
  int most_attempts = 40;        ///< draws for one number
  MotionSettings motion;
  SearchSettings search;
};

/// A draw, and whether it became a scene of the matrix.
struct DrawnRow
{
  SceneNumber number;
  SceneParams params;
  double node_steps = 0.0;
  Reference motion;  ///< without its samples
};

/// Draws the scenes of one half, finds their exact motion and searches for the cheapest way to it. Nothing here depends
/// on a planner.
class SceneSearch
{
public:
  SceneSearch(const MatrixFolder& folder, Half half, const MatrixSettings& settings, Solvers solvers,
              std::unique_ptr<Solver> independent);

  /// Does all that is not there yet.
  void run();

private:
  void run(int number);
  /// The draw, kept as a scene where it has an exact motion.
  DrawnRow draw(const SceneNumber& number);
  Reference motion_of(const MatrixScene& scene);
  void search(const MatrixScene& scene);
  void begin(const std::string& what);
  void write_table() const;

  const MatrixFolder& folder_;
  Half half_;
  MatrixSettings settings_;
  Solvers solvers_;
  std::unique_ptr<Solver> independent_;
  Journal journal_;
  Progress progress_;
  std::vector<DrawnRow> draws_;
  bool has_worked_ = false;  ///< on this number
};

/// Every method of the table, those that are cheap for most scenes first: what they cost limits what is tried of
/// others.
Solvers solvers_to_search();

}  // namespace cloth
