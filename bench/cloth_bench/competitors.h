#pragma once

#include "solver.h"

namespace cloth
{

/// Solvers that others have written, on the same equations: those that were there when this was built.
Solvers competitors();

/// The one that references are checked with: null where there is none.
std::unique_ptr<Solver> independent_solver();

/// One line for each that is left out, with what would bring it in.
std::vector<std::string> left_out_competitors();

}  // namespace cloth
