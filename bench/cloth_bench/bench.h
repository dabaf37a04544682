#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench_scene.h"
#include "journal.h"
#include "progress.h"
#include "reference.h"
#include "tables.h"

namespace cloth
{

/// How much is done.
struct BenchSettings
{
  double longest_horizon = 0.5;        ///< s
  double most_node_steps = 2e7;        ///< see `horizon_of`
  double smallest_error = 1e-7;        ///< m; a ladder ends below it
  double most_seconds = 1.0;           ///< of processor time, of one run
  double ratio = 2.0;                  ///< between neighbouring steps of a ladder
  int most_repeats = 5;                ///< of short runs; of those of `most_seconds` two
  double least_timed = 0.01;           ///< s; shorter runs are made again until they come to this
  ReferenceSettings reference;         ///< of trajectories
  double limited_disagreement = 1e-4;  ///< m, allowed to a reference with the strain limit
  double limited_seconds = 8.0;        ///< of processor time, of one run towards it
  double spatial_seconds = 20.0;       ///< of processor time, of one run of the spatial comparison; 0: there is none

  /// In a tenth of the time: what it is for can be seen, no more.
  static BenchSettings quick();
};

/// Runs scenes by all solvers and keeps what comes of it in a folder, where a run that was cut short goes on.
class Bench
{
public:
  /// `independent`, which may be null, checks the references of trajectories. Throws std::runtime_error where the
  /// folder cannot be used.
  Bench(const std::string& folder, const BenchSettings& settings, Solvers solvers, std::unique_ptr<Solver> independent,
        const Provenance& provenance);

  /// Runs all that is not there yet, and writes the tables after every part. `ends_early`, where given, is asked before
  /// every run; once it says so nothing more is run. False: no
  /// scene has a reference that can be trusted.
  bool run(const std::vector<BenchScene>& scenes, const std::function<bool()>& ends_early = {});

private:
  struct Ended
  {
  };

  void run(const BenchScene& scene, Kind kind);
  void run_spatial(const BenchScene& scene);
  void say_if_changed(const SceneRow& row);
  Reference reference_of(const Problem& problem, const std::string& fingerprint);
  /// Runs the solver's ladder from coarse to fine and returns the rows that came to their end.
  std::vector<Measurement> climb(const Solver& solver, const Problem& problem, const Reference& reference,
                                 const SceneRow& row);
  /// The first run of a row, from the journal or now.
  Measurement first_run(const Solver& solver, const Problem& problem, double value, const Reference& reference,
                        const Measurement& row, double expected_seconds);
  void repeat_in_turn(const Problem& problem, const std::vector<std::pair<const Solver*, Measurement>>& rows);
  void add(const Measurement& measurement);
  void finish_part();
  /// Throws Ended where nothing more is to be run.
  void begin_work(const std::string& what);
  SceneRow scene_row(const BenchScene& scene, Kind kind, double horizon) const;

  std::string folder_;
  BenchSettings settings_;
  Solvers solvers_;
  std::unique_ptr<Solver> independent_;
  Provenance provenance_;
  Journal journal_;
  Progress progress_;
  std::vector<SceneRow> scene_rows_;
  std::function<bool()> ends_early_;
  bool has_worked_ = false;  ///< in this part
};

}  // namespace cloth
