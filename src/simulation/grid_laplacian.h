#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "cloth_sim/constraints/pins.h"
#include "cloth_sim/model/cloth_model.h"

namespace cloth
{

/// The Laplacian M of the grid of free nodes, factorised: u M u is the sum of k |u_i - u_j|^2 over neighbours. So
/// |u|_M grows with the turn of springs and not with the way that all go together, which is how far the Hessian of
/// their energy can be trusted; and conjugate gradients preconditioned with M need as many products on a fine grid as
/// on a coarse one.
class GridLaplacian
{
public:
  GridLaplacian(const ClothModel& model, const Pins& pins);

  /// M^-1 `rows`, one row a node, zero for held nodes.
  void solve(const Vectors& rows, Vectors& result) const;

private:
  void solve_in_place() const;
  std::vector<Eigen::Triplet<double>> entries_of(const ClothModel& model) const;
  void add(int i, int j, double stiffness, std::vector<Eigen::Triplet<double>>& entries) const;

  std::vector<int> places_;  ///< of a node among the free ones; -1: it is held
  std::vector<int> free_;
  Eigen::SparseMatrix<double> lower_;  ///< the Cholesky factor L of the Laplacian, its rows in the order of `order_`
  std::vector<int> order_;
  mutable Eigen::Matrix4Xd solution_;  ///< x, y, z and a zero, which fills a register
};

}  // namespace cloth
