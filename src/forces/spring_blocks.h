#pragma once

// How the loops over springs are laid out.

#include <algorithm>
#include <cmath>

#include "cloth_sim/model/spring_batch.h"
#include "cloth_sim/model/vectors.h"

namespace cloth
{

/// Rows are done in blocks: what is computed for a block stays in the nearest cache, and the loops over it, which
/// read and write different arrays, vectorise.
inline constexpr int block_size = 128;

/// One vector for each spring of a block.
struct Block
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

/// Adds the block's vectors to the first ends and takes them from the second ends.
inline void add_to_both_ends(const Block& block, int i, int offset, int n, Vectors& vectors)
{
  const double* const columns[] = { block.x, block.y, block.z };
  for (int d = 0; d < 3; ++d)
  {
    const double* const added = columns[d];
    double* const first = vectors.col(d).data() + i;
    double* const second = first + offset;
    for (int s = 0; s < n; ++s)
    {
      first[s] += added[s];
    }
    for (int s = 0; s < n; ++s)
    {
      second[s] -= added[s];
    }
  }
}

/// 1/|l|, or 0 for a spring of no length: it has no direction, and no force.
inline double inverse_length(const Vector& l)
{
  const double squared = l.dot(l);
  return squared > 0.0 ? 1.0 / std::sqrt(squared) : 0.0;
}

/// block[s] = factor * l
inline void put(Block& block, int s, double factor, const Vector& l)
{
  block.x[s] = factor * l.x;
  block.y[s] = factor * l.y;
  block.z[s] = factor * l.z;
}

}  // namespace cloth
