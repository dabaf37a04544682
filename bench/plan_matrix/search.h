#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "journal.h"
#include "solver.h"

namespace cloth
{

struct SearchSettings
{
  std::vector<double> tolerances{ 1e-2, 1e-3, 1e-4 };  ///< m, root mean square over all nodes and times
  double drop_factor = 3.0;     ///< a run that takes so many times the best of those that are exact enough is dropped
  double most_seconds = 60.0;   ///< of processor time, of one run
  double ratio = 2.0;           ///< between the settings of a ladder
  int most_slow_starts = 2;     ///< settings that may be dropped before any has come to its end: equations of long
                                ///< steps take long to solve, and a shorter one may be quicker
  int refinements = 2;          ///< times that the gap in which a tolerance begins to be met is halved
  double worth_refining = 1.5;  ///< where a run in the gap would cost at most so many times the best
  double worth_repeating = 1.25;
  int most_repeats = 3;
  double least_timed = 0.02;  ///< s; shorter runs are made again until they come to this
};

/// What a row costs: lengths of the yardstick for a simulated second.
double cost_of(const Measurement& row);

/// Of at least one number.
double median(std::vector<double> numbers);

/// One setting of one solver, with the median cost of its repeats.
struct Contender
{
  Measurement row;
  double cost = 0.0;
};

/// All settings among the rows that came to their end and solved their equations.
std::vector<Contender> contenders_of(const std::vector<Measurement>& rows);

/// The cheapest whose error is at most `tolerance` (m), if there is one.
std::optional<Contender> best_of(const std::vector<Measurement>& rows, double tolerance);

/// Runs all solvers over their settings from coarse to fine, and none beyond what could still be the best for some
/// tolerance. It depends on the solvers and the machine, and on no planner.
class Search
{
public:
  /// `begins` is told of every run before it is made.
  Search(const Problem& problem, const std::vector<ClothState>& exact, const SearchSettings& settings, Journal& journal,
         const std::string& fingerprint, std::function<void(const std::string&)> begins);

  /// All rows: from the journal, or made now and kept there.
  const std::vector<Measurement>& run(const Solvers& solvers);

private:
  /// What a row of `solver` may cost and still matter; infinite while a tolerance is not met by any.
  double most_cost(const Solver& solver) const;
  void climb(const Solver& solver);
  void refine(const Solver& solver, double tolerance);
  void repeat(const Solvers& solvers, double tolerance);
  Measurement measure(const Solver& solver, double value, double most_cost, double expected_cost);
  Measurement row_for(const Solver& solver, double value) const;

  const Problem& problem_;
  const std::vector<ClothState>& exact_;
  const SearchSettings& settings_;
  Journal& journal_;
  std::string fingerprint_;
  std::function<void(const std::string&)> begins_;
  std::vector<Measurement> rows_;
};

}  // namespace cloth
