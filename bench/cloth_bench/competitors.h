#pragma once

#include "solver.h"

namespace cloth
{

/// Solvers that others have written, on the same equations (Bullet: on its own, which are near to them where springs
/// are stiff): those that were there when this was built.
Solvers competitors();

/// The one that references are checked with: odeint's formula of order 8, or CVODE's of Adams, which takes several
/// times as long at tight tolerances; null where there is none.
std::unique_ptr<Solver> independent_solver();

/// One line for each that is left out, with what would bring it in.
std::vector<std::string> left_out_competitors();

}  // namespace cloth
