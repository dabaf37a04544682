#pragma once

#include <string>

#include "reference.h"
#include "solver.h"

namespace cloth
{

struct MotionSettings
{
  double first_tolerance = 1e-9;      ///< m, of dopri5
  double tightest_tolerance = 1e-13;  ///< m; tightened tenfold at a time while its checks disagree
  double most_disagreement = 4e-6;    ///< m; 4 % of the tightest tolerance that a planner is given
  double most_seconds = 120.0;        ///< of processor time, of one run
  double most_growth = 1e5;           ///< of a disturbance of 1e-9 m; beyond it the motion is chaos
};

/// The motion of `problem` by dopri5, over its whole horizon or not at all. It is accepted when `independent` comes
/// within the disagreement allowed; where there is none, or it may take longer than a run is given, when dopri5 itself
/// at a tenfold tolerance and rk4 at half its stability limit do. The reason says which it was, or why it is refused. A
/// chaotic motion is refused: what a method leaves in its first steps, however little, decides where the sheet ends,
/// and errors do not fall with the step as the method's order says.
Reference find_exact_motion(const Problem& problem, const Solver* independent, const MotionSettings& settings);

/// Another motion of the same kind of sheet, unchecked; refused where it does not come to its end.
Reference find_unchecked_motion(const Problem& problem, const MotionSettings& settings);

}  // namespace cloth
