#pragma once

#include <vector>

#include <Eigen/Cholesky>

#include "grid_matrix.h"

namespace cloth
{

/// A preconditioner for the systems of implicit methods on a sheet, A = D + P (SpringJacobian): one symmetric V-cycle
/// of geometric multigrid (Brandt, "Multi-level adaptive solutions to boundary-value problems", 1977; as a
/// preconditioner: Tatebe, "The multigrid preconditioned conjugate gradient method", 1993). Coarser grids have every
/// second row and column; their matrices are I^T A I, I being bilinear interpolation. On each, one sweep of block
/// Jacobi before the coarser grid's correction and one after; the coarsest, of at most 3 x 3 nodes, is solved.
///
/// So conjugate gradients need about as many iterations on a fine grid as on a coarse one.
class Multigrid
{
public:
  /// For the matrix of `diagonal` (kg, one a node) and of `springs`. No chain: that has no grid. `pins` hold nodes that
  /// are no unknowns.
  void prepare(const ClothModel& model, const Pins& pins, const Eigen::ArrayXd& diagonal,
               const SpringJacobian& springs);

  /// z = B r with B close to the inverse of A, symmetric, and positive definite if A is; zero for held nodes. Where
  /// none is held the sum of m z is that of r, as A^-1 would have it without air: the momentum is what it was.
  void apply(const Vectors& r, Vectors& z);

private:
  /// Of the inverse of a node's block. The eigenvalues of what block Jacobi iterates with are at most 2 on the finest
  /// grid and were found to be at most 2.4 on others: below 2/0.7.
  static constexpr double relaxation = 0.7;

  struct Level
  {
    Level(int rows, int cols);

    GridMatrix matrix;
    GridArray inverses;
    GridArray right;
    GridArray solution;
    GridArray remainder;
    GridMatrix halved;  ///< on the way to the next level: half as many rows
  };

  void make_levels(const ClothModel& model);
  void improve(size_t level);
  void solve_coarsest();
  static void start(Level& level);
  static void find_remainder(Level& level);
  static void relax(Level& level);
  static void restrict_remainder(Level& fine, Level& coarse);
  static void add_correction(const Level& coarse, Level& fine);

  std::vector<Level> levels_;
  Eigen::LLT<Eigen::MatrixXd> coarsest_;
  Eigen::VectorXd masses_;
  std::vector<int> held_;
};

}  // namespace cloth
