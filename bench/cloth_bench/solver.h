#pragma once

#include <memory>
#include <string>
#include <vector>

#include "problem.h"

namespace cloth
{

/// What a ladder varies.
enum class Setting
{
  step,           ///< s
  tolerance,      ///< m
  iterations,     ///< a step
  nodes_per_side  ///< down the sheet
};

const char* name_of(Setting setting);

enum class Status
{
  ok,
  unstable,
  not_converged,
  too_slow
};

const char* name_of(Status status);

/// What came of a run.
struct Outcome
{
  Status status = Status::ok;
  std::vector<ClothState> samples;  ///< at the problem's times; all of them only where the run came to its end
  double seconds = 0.0;             ///< of processor time, all in all
  double seconds_per_second = 0.0;  ///< processor time per simulated second, without the first interval
  double yardstick = 1.0;           ///< its length meanwhile, s
  double force_evaluations = 0.0;   ///< per simulated second
  double linear_solves = 0.0;       ///< likewise
};

/// A way to find motions, more or less exactly as one number is set.
class Solver
{
public:
  virtual ~Solver() = default;

  virtual std::string name() const = 0;
  virtual Setting setting() const = 0;

  /// The settings from coarse to fine, of which `ratio` is the wanted factor between neighbours, 2 or more.
  virtual std::vector<double> ladder(const Problem& problem, double ratio) const = 0;

  /// Finds the motion; gives up as too slow after about `most_seconds` of processor time.
  virtual Outcome run(const Problem& problem, double value, double most_seconds) const = 0;

  /// Why it cannot run this problem at all; empty: it can.
  virtual std::string obstacle(const Problem&) const
  {
    return {};
  }
};

using Solvers = std::vector<std::unique_ptr<Solver>>;

}  // namespace cloth
