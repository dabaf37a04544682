#pragma once

#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/methods/method.h"

namespace cloth
{

/// The stiffest mode of a network as it is now, by power iteration between a lower and an upper bound:
/// - the power iteration's Rayleigh quotient, never above the true eigenvalue, raised by a margin;
/// - 2/m_i times the largest eigenvalue of the 3 x 3 block of node i, over all nodes: never below it.
/// The smaller of the two is taken, for the stiffness and for the damping matrix. Keeps its vectors, so that asking
/// again after a small change costs little.
class Spectrum
{
public:
  /// Linearises about `positions` (m), springs under compression counted without their destabilising part, pinned
  /// nodes at rest.
  Mode stiffest_mode(const Dynamics& dynamics, const Vectors& positions);

private:
  Vectors stiffness_vector_;
  Vectors damping_vector_;
};

}  // namespace cloth
