#pragma once

#include <vector>

#include "cloth_sim/model/cloth_model.h"

namespace cloth
{

/// At most `spring_row_size` springs of a batch: spring k < n joins node + k and the node `offset` further on.
struct SpringRun
{
  size_t batch;
  int node;
  int offset;
  int n;
};

/// Springs by runs of those that are corrected in one go, row of nodes by row of nodes.
std::vector<SpringRun> runs_by_rows(const std::vector<SpringBatch>& batches, int rows);

/// The nodes of a sheet renumbered so that the columns of a row come in turns, one from each of 16 stretches of columns
/// side by side: neighbours in a row are then a whole vector of single precision apart, and no two springs of a run
/// share a node, whatever their direction. Rows go on to a whole number of vectors, with nodes that no spring joins.
class LaneLayout
{
public:
  explicit LaneLayout(const ClothModel& model);

  /// With those that no spring joins.
  int nodes() const
  {
    return rows_ * vectors_a_row_ * lanes;
  }
  int number(int row, int col) const
  {
    return (row * vectors_a_row_ + col % vectors_a_row_) * lanes + col / vectors_a_row_;
  }
  /// The number of a node of the model.
  int operator[](int node) const
  {
    return number(node / cols_, node % cols_);
  }

  /// The springs in runs of a vector each, by bands of so many rows and batch by batch in each; neighbouring runs of a
  /// batch share no node.
  std::vector<SpringRun> runs(const std::vector<SpringBatch>& batches, int rows_a_band) const;

private:
  static constexpr int lanes = 16;

  struct Way
  {
    int down;
    int across;
  };

  Way way_of(const SpringBatch& batch) const;
  SpringRun run_from(Way way, int row, int vector) const;

  int rows_;
  int cols_;
  int vectors_a_row_;
};

}  // namespace cloth
