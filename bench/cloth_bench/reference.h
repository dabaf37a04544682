#pragma once

#include <string>
#include <vector>

#include "solver.h"

namespace cloth
{

struct ReferenceSettings
{
  double first_tolerance = 1e-11;     ///< m, of both solvers
  double tightest_tolerance = 1e-13;  ///< m; tightened tenfold at a time while the two disagree
  double most_disagreement = 1e-9;    ///< m; 1 % of the smallest error that is to be drawn
  double most_seconds = 40.0;         ///< of processor time, of one run
  double rounding = 1e-15;            ///< m; what it may leave of a position in a run where nothing grows
  int most_halvings = 4;              ///< of the horizon
};

/// A motion that others are held against.
struct Reference
{
  bool accepted = false;
  double horizon = 0.0;             ///< s
  double disagreement = 0.0;        ///< of the two solvers, as a root mean square over nodes and times, m
  double growth = 0.0;              ///< of a disturbance of 1e-9 m, as a factor; 0: not measured
  std::string reason;               ///< why it is not accepted, or why the horizon is shorter than it was asked for
  std::vector<ClothState> samples;  ///< at the problem's times
};

/// The motion of `problem` by dopri5, accepted when `other` comes within the disagreement allowed. A disturbance of
/// 1e-9 m that grows so much that rounding could come to that disagreement limits the horizon. Where the two do not
/// agree, or take too long, the horizon is halved, and in the end the problem is refused.
Reference find_reference(const Problem& problem, const Solver* other, const ReferenceSettings& settings);

/// The motion with the strain limit at h -> 0: velocity_verlet at the step, of ever shorter ones, where it disagrees least
/// with itself at twice that and with rk4, the larger of the two. That need not be the shortest: what the limit leaves
/// within its tolerance becomes speed over the step, and below some step may outweigh what the step itself does.
/// Refused where the disagreement is more than `most_disagreement`.
Reference find_limited_reference(const Problem& problem, const ReferenceSettings& settings);

}  // namespace cloth
