#pragma once

#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/methods/method.h"

namespace cloth
{

/// The stiffest mode of a network, linearised about `positions` (m), pinned nodes at rest. Springs under compression
/// count without their destabilising part (see `add_stiffness_product`).
///
/// omega^2, the largest eigenvalue of M^-1 K, comes from the Lanczos form of the power iteration, 16 products from a
/// vector of noise. Its Ritz value is never above the eigenvalue; with the residual added it is a bound that is hardly
/// ever missed (Zhou and Li, "Bounding the spectrum of large Hermitian matrices", 2011), and 2 % are added for the
/// rest. Where the bound of `stiffness_bound` is lower, that is taken.
///
/// The damping rate is bounded: C is at most max(c/k) K, and obeys the same bound by blocks as K does.
Mode stiffest_mode(const Dynamics& dynamics, const Vectors& positions);

/// A bound that holds for omega^2, 1/s2, at the price of two force evaluations: each spring's 6 x 6 matrix [A -A; -A A]
/// is at most twice its diagonal blocks, so no eigenvalue of M^-1 K exceeds the largest of 2/m_i times that of node
/// i's block, the sum of A over its springs. Exact inside a flat uniform sheet, up to 1.5 times too large on shipped
/// scenes.
double stiffness_bound(const Dynamics& dynamics, const Vectors& positions);

}  // namespace cloth
