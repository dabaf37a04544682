#pragma once

#include <functional>

#include "cloth_sim/methods/dynamics.h"

namespace cloth
{

/// What the springs of a batch give to A = sum of a n n^T + b max(0, 1 - l0/|l|) (I - n n^T), n = l/|l|.
struct BlockCoefficients
{
  double along;   ///< a
  double across;  ///< b
};

/// For each node what the largest of all is a bound that holds for the largest eigenvalue of M^-1 times the matrix that
/// has A on the diagonal and -A beside it for every spring, held nodes left out: [A -A; -A A] is at most twice its
/// diagonal blocks, so it is 2/m_i times the largest eigenvalue of node i's block, the sum of A over its springs; 0 for
/// held nodes. No coefficient may be negative.
Eigen::VectorXd block_bounds(const Dynamics& dynamics, const Vectors& positions,
                             const std::function<BlockCoefficients(const SpringBatch&)>& coefficients);

}  // namespace cloth
