#pragma once

// How the loops over springs are laid out.

#include <algorithm>

#include "cloth_sim/model/inverse_root.h"
#include "cloth_sim/model/node_range.h"
#include "cloth_sim/model/spring_batch.h"
#include "cloth_sim/model/vectors.h"

namespace cloth
{

/// Rows are done in blocks: what is computed for a block stays in the nearest cache, and the loops over it, which
/// read and write different arrays, vectorise.
inline constexpr int block_size = 256;

/// One vector for each spring of a block.
struct alignas(64) Block
{
  double x[block_size];
  double y[block_size];
  double z[block_size];
};

struct Vector
{
  double x;
  double y;
  double z;

  double dot(const Vector& other) const
  {
    return x * other.x + y * other.y + z * other.z;
  }
};

/// The differences u_j - u_i over the springs of a block, the first of which joins i and i + offset.
class Differences
{
public:
  Differences(const Vectors& vectors, int i, int offset)
    : x_(vectors.col(0).data() + i), y_(vectors.col(1).data() + i), z_(vectors.col(2).data() + i), offset_(offset)
  {
  }

  Vector operator[](int s) const
  {
    return { x_[s + offset_] - x_[s], y_[s + offset_] - y_[s], z_[s + offset_] - z_[s] };
  }

private:
  const double* x_;
  const double* y_;
  const double* z_;
  int offset_;
};

/// Calls work(i, n) for the blocks of a batch: n springs, the first of which joins i and i + offset.
template <typename Work>
void for_each_block(const SpringBatch& batch, Work&& work)
{
  for (int r = 0; r < batch.rows; ++r)
  {
    const int begin = batch.first + r * batch.row_stride;
    for (int done = 0; done < batch.cols; done += block_size)
    {
      work(begin + done, std::min(block_size, batch.cols - done));
    }
  }
}

/// Adds the block's vectors s in [from, to), times 1 or -1, to the nodes i + s.
inline void add_to_nodes(const Block& block, double sign, int i, int from, int to, Vectors& vectors)
{
  const double* const columns[] = { block.x, block.y, block.z };
  for (int d = 0; d < 3; ++d)
  {
    const double* const added = columns[d];
    double* const sums = vectors.col(d).data() + i;
#pragma GCC ivdep
    for (int s = from; s < to; ++s)
    {
      sums[s] += sign * added[s];
    }
  }
}

/// Adds the block's vectors to the first ends and takes them from the second ends.
inline void add_to_both_ends(const Block& block, int i, int offset, int n, Vectors& vectors)
{
  add_to_nodes(block, 1.0, i, 0, n, vectors);
  add_to_nodes(block, -1.0, i + offset, 0, n, vectors);
}

/// Zeroes the vectors of nodes from which no spring of the batch begins: `block` begins with node i.
inline void clear_gaps(const SpringBatch& batch, int i, int n, Block& block)
{
  const int gap = batch.row_stride - batch.cols;
  if (gap == 0)
  {
    return;
  }
  const int row = (i - batch.first) / batch.row_stride;
  for (int begin = batch.first + row * batch.row_stride + batch.cols - i; begin < n; begin += batch.row_stride)
  {
    for (int s = std::max(0, begin); s < std::min(n, begin + gap); ++s)
    {
      block.x[s] = block.y[s] = block.z[s] = 0.0;
    }
  }
}

/// Adds to the first ends of springs what work(batch, i, n, block) puts into the block for n springs, the first of
/// which joins i and i + offset, and `second` times that to the second ends. Springs of all batches whose first ends
/// are in `first_ends`, and of their ends those in `nodes`. Rows of springs are not kept apart: what the block gets for
/// the gaps between them is not used.
///
/// All batches are done for one block of nodes before the next, while these are in the nearest cache.
template <typename Work>
void add_by_blocks(const ClothModel& model, NodeRange first_ends, NodeRange nodes, double second, Vectors& vectors,
                   Work&& work)
{
  Block block;
  for (int begin = first_ends.begin; begin < first_ends.end; begin += block_size)
  {
    const int end = std::min(begin + block_size, first_ends.end);
    for (const SpringBatch& batch : model.springs)
    {
      const int beyond_last = batch.first + (batch.rows - 1) * batch.row_stride + batch.cols;
      const int i = std::max({ begin, batch.first, nodes.begin - batch.offset });
      const int n = std::min({ end, beyond_last, nodes.end }) - i;
      if (n <= 0)
      {
        continue;
      }
      work(batch, i, n, block);
      clear_gaps(batch, i, n, block);
      add_to_nodes(block, 1.0, i, std::max(0, nodes.begin - i), n, vectors);
      add_to_nodes(block, second, i + batch.offset, 0, std::min(n, nodes.end - batch.offset - i), vectors);
    }
  }
}

/// 1/|l|, or 0 for a spring of no length: it has no direction, and no force.
template <bool fused>
double inverse_length(const Vector& l)
{
  return inverse_root<fused>(l.dot(l));
}

/// block[s] = factor * l
inline void put(Block& block, int s, double factor, const Vector& l)
{
  block.x[s] = factor * l.x;
  block.y[s] = factor * l.y;
  block.z[s] = factor * l.z;
}

}  // namespace cloth
