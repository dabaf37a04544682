#pragma once

#include <vector>

#include <Eigen/Core>

#include "cloth_sim/model/cloth_model.h"

namespace cloth
{

/// The springs' part of the matrix of an implicit step, P = p K + q C, as a product with vectors:
///
///   K = -df/dx = sum over springs of  k [n n^T + (1 - l0/|l|) (I - n n^T)]   (elastic force; n = l/|l|)
///   C = -df/dv = sum over springs of  c n n^T                                (internal damping)
///
/// each with + on its two ends and - across. The derivative of the damping force by the positions is left out: it would
/// make the matrix unsymmetric, and a small error in the matrix costs Newton's method a little speed, not accuracy
/// (Baraff and Witkin, "Large steps in cloth simulation", 1998, leave it out of their damping as well).
///
/// Under compression 1 - l0/|l| is negative, and K may be indefinite. Leaving the negative part out (Choi and Ko,
/// "Stable but responsive cloth", 2002) is safe and slow to converge; here as much of it is kept as the masses can
/// carry, see `linearise`.
class SpringJacobian
{
public:
  /// Of each spring of a batch the matrix `across` I + w w^T, in memory order.
  struct LinearisedBatch
  {
    SpringBatch batch;
    std::vector<double> across;
    std::vector<double> w_x;
    std::vector<double> w_y;
    std::vector<double> w_z;
  };

  /// Linearises the springs at `positions` (m) for the factors p and q. `capacities` (kg, one a node) say how much
  /// negative stiffness p k (1 - l0/|l|) a node can carry: where the sum over its springs is above half of it, that of
  /// each is cut down in proportion. By Gershgorin's theorem for blocks, diag(capacities) + P is then positive
  /// semidefinite.
  void linearise(const ClothModel& model, const Vectors& positions, double stiffness_factor, double damping_factor,
                 const Eigen::ArrayXd& capacities);

  /// Adds P u. One row a node.
  void add_product(const Vectors& u, Vectors& product) const;

  /// As they were linearised last.
  const std::vector<LinearisedBatch>& batches() const
  {
    return batches_;
  }

private:
  void take_directions(const Vectors& positions, double stiffness_factor, LinearisedBatch& linearised);
  void cut_negative_stiffness(const Eigen::ArrayXd& kept_parts, LinearisedBatch& linearised) const;
  static void scale_directions(double along, LinearisedBatch& linearised);

  std::vector<LinearisedBatch> batches_;
  Eigen::ArrayXd negative_sums_;
};

}  // namespace cloth
