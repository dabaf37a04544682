#pragma once

#include <vector>

#include <Eigen/Sparse>

#include "cloth_sim/methods/dynamics.h"

namespace cloth
{

/// The matrix M + h C + h^2 K of SpringJacobian and Air, 3n x 3n, assembled. Where its entries are is found out once;
/// rows and columns of pinned nodes have their mass alone.
class AssembledMatrix
{
public:
  using Matrix = Eigen::SparseMatrix<double>;

  explicit AssembledMatrix(const Dynamics& dynamics);

  /// Arguments as `SpringJacobian::linearise` and `Air::add_damping_product` have them.
  void assemble(const Vectors& positions, const Vectors& normals, double h, const Eigen::ArrayXd& capacities);

  const Matrix& matrix() const
  {
    return matrix_;
  }

private:
  /// The 3 x 3 block of a pair of nodes: its first value, and how far one column's value is from the next column's.
  struct Block
  {
    int first = -1;
    int stride = 0;
  };

  struct SpringBlocks
  {
    Block of_ends[2];
    Block across[2];
  };

  bool is_free(int node) const
  {
    return !dynamics_.pins().holds(node);
  }
  void find_pattern();
  Block block_of(int row_node, int col_node) const;
  void add(const Block& block, const Eigen::Matrix3d& values);
  void add_masses_and_air(const Vectors& normals, double h);
  Eigen::ArrayXd negative_sums(const Vectors& positions, double h) const;

  const Dynamics& dynamics_;
  Matrix matrix_;
  std::vector<Block> of_nodes_;
  std::vector<SpringBlocks> of_springs_;  // in the order of the batches
};

}  // namespace cloth
