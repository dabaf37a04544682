#pragma once

#include <algorithm>
#include <vector>

#include "cloth_sim/constraints/pins.h"
#include "cloth_sim/forces/spring_jacobian.h"
#include "cloth_sim/model/cloth_model.h"

namespace cloth
{

/// Every second node of a row of nodes and its last: what the next coarser grid keeps. Up to `fewest` nodes it keeps
/// all.
struct Halving
{
  static constexpr int fewest = 3;

  int fine;

  int coarse() const
  {
    return fine > fewest ? fine / 2 + 1 : fine;
  }
  /// The place on the finer grid of number c.
  int node(int c) const
  {
    return fine > fewest ? std::min(2 * c, fine - 1) : c;
  }
  /// A node of the finer grid lies between number c and the next, in their middle.
  bool has_between(int c) const
  {
    return c >= 0 && c + 1 < coarse() && node(c + 1) - node(c) == 2;
  }
};

/// Values for the nodes of a grid, `components` of each, a row of nodes after the other: all of a row's first ones,
/// then all of its second ones. Rows are filled up to whole vectors and at least one more value, of zeros; a row of
/// zeros lies before the first, and one behind the last. So the eight neighbours of every node can be read.
class GridArray
{
public:
  GridArray(int rows, int cols, int components);

  int rows() const
  {
    return rows_;
  }
  int cols() const
  {
    return cols_;
  }
  /// From a component's values in a row to those of the next.
  int pitch() const
  {
    return pitch_;
  }
  double* row(int row, int component = 0)
  {
    return values_.data() + place(row, component);
  }
  const double* row(int row, int component = 0) const
  {
    return values_.data() + place(row, component);
  }
  void clear()
  {
    std::fill(values_.begin(), values_.end(), 0.0);
  }

private:
  static constexpr int widest = 8;

  size_t place(int row, int component) const
  {
    return (static_cast<size_t>(row + 1) * static_cast<size_t>(components_) + static_cast<size_t>(component)) *
           static_cast<size_t>(pitch_);
  }

  int rows_;
  int cols_;
  int components_;
  int pitch_;
  std::vector<double> values_;
};

/// A symmetric matrix on a grid in which a node has to do with itself and its eight neighbours, a symmetric 3 x 3 block
/// for each pair. What is kept are the blocks of a node with itself and with its neighbours to the east, the south, the
/// south-east and the south-west. Nodes whose block with themselves is zero are out of it.
class GridMatrix
{
public:
  GridMatrix(int rows, int cols);

  int rows() const
  {
    return blocks_.rows();
  }
  int cols() const
  {
    return blocks_.cols();
  }

  /// `diagonal` (one a node) and P of `springs`, without what pins hold. A spring that bends, over two nodes further,
  /// counts as two of twice the strength from node to node: for smooth motions they are the same, for none they are
  /// less.
  void fill(const ClothModel& model, const Pins& pins, const Eigen::ArrayXd& diagonal, const SpringJacobian& springs);

  /// I^T F I, I being linear interpolation along the columns of nodes from the rows that the halving keeps.
  void fill_by_halving_rows(const GridMatrix& finer);
  /// The same along the rows of nodes.
  void fill_by_halving_cols(const GridMatrix& finer);

  /// Subtracts A u from `vectors`.
  void subtract_product(const GridArray& u, GridArray& vectors) const;

  /// `factor` times the inverse of every node's block with itself, six values a node; zero for those that are out.
  void invert_centres(double factor, GridArray& inverses) const;

  /// The same matrix with all its zeros, 1 on the diagonal for nodes that are out.
  Eigen::MatrixXd dense() const;

  /// Of a block: xx, yy, zz, xy, xz, yz.
  static constexpr int values_a_block = 6;

private:
  enum Neighbour
  {
    centre,
    east,
    south,
    south_east,
    south_west,
    neighbours
  };

  struct Way
  {
    int down;
    int across;
  };

  static Way way_to(Neighbour neighbour);
  double* block_row(int row, Neighbour neighbour)
  {
    return blocks_.row(row, neighbour * values_a_block);
  }
  const double* block_row(int row, Neighbour neighbour) const
  {
    return blocks_.row(row, neighbour * values_a_block);
  }
  void add_springs(const SpringJacobian::LinearisedBatch& batch, int from, double factor, Neighbour neighbour);

  GridArray blocks_;
  std::vector<double> free_;  ///< one a node: 1, or 0 where a pin holds it
};

}  // namespace cloth
