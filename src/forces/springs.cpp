#include "cloth_sim/forces/springs.h"

#include <algorithm>
#include <cmath>

namespace cloth
{
namespace
{

/// Rows are done in blocks: what is computed for a block stays in the nearest cache, and the loops over it, which
/// read and write different arrays, vectorise.
constexpr int block_size = 128;

struct Block
{
  double x[block_size];
  double y[block_size];
  double z[block_size];
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

/// block = u_j - u_i for the springs of a block.
void differences(const Vectors& vectors, int i, int offset, int n, Block& block)
{
  const double* const x = vectors.col(0).data() + i;
  const double* const y = vectors.col(1).data() + i;
  const double* const z = vectors.col(2).data() + i;
  for (int s = 0; s < n; ++s)
  {
    block.x[s] = x[s + offset] - x[s];
    block.y[s] = y[s + offset] - y[s];
    block.z[s] = z[s + offset] - z[s];
  }
}

/// Adds the block's vectors to the first ends and takes them from the second ends.
void add_to_both_ends(const Block& block, int i, int offset, int n, Vectors& vectors)
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
inline double inverse_length(double x, double y, double z)
{
  const double squared = x * x + y * y + z * z;
  return squared > 0.0 ? 1.0 / std::sqrt(squared) : 0.0;
}

}  // namespace

void add_spring_forces(const ClothModel& model, const Vectors& positions, const Vectors& velocities, Vectors& forces)
{
  for (const SpringBatch& batch : model.springs)
  {
    const double k = batch.stiffness;
    const double c = batch.damping;
    const double l0 = batch.rest_length;
    Block l;
    if (c == 0.0)
    {
      for_each_block(batch, [&](int i, int n) {
        differences(positions, i, batch.offset, n, l);
        for (int s = 0; s < n; ++s)
        {
          const double tension = k - k * l0 * inverse_length(l.x[s], l.y[s], l.z[s]);
          l.x[s] *= tension;
          l.y[s] *= tension;
          l.z[s] *= tension;
        }
        add_to_both_ends(l, i, batch.offset, n, forces);
      });
      continue;
    }
    Block w;
    for_each_block(batch, [&](int i, int n) {
      differences(positions, i, batch.offset, n, l);
      differences(velocities, i, batch.offset, n, w);
      for (int s = 0; s < n; ++s)
      {
        const double inverse = inverse_length(l.x[s], l.y[s], l.z[s]);
        const double approach = (w.x[s] * l.x[s] + w.y[s] * l.y[s] + w.z[s] * l.z[s]) * inverse;
        const double tension = k + (c * approach - k * l0) * inverse;
        l.x[s] *= tension;
        l.y[s] *= tension;
        l.z[s] *= tension;
      }
      add_to_both_ends(l, i, batch.offset, n, forces);
    });
  }
}

double elastic_energy(const ClothModel& model, const Vectors& positions)
{
  double energy = 0.0;
  Block l;
  for (const SpringBatch& batch : model.springs)
  {
    double squares = 0.0;
    for_each_block(batch, [&](int i, int n) {
      differences(positions, i, batch.offset, n, l);
      for (int s = 0; s < n; ++s)
      {
        const double extension = std::sqrt(l.x[s] * l.x[s] + l.y[s] * l.y[s] + l.z[s] * l.z[s]) - batch.rest_length;
        squares += extension * extension;
      }
    });
    energy += 0.5 * batch.stiffness * squares;
  }
  return energy;
}

double max_strain(const ClothModel& model, const Vectors& positions)
{
  double largest = 0.0;
  Block l;
  for (const SpringBatch& batch : model.springs)
  {
    if (batch.kind == SpringKind::flex)
    {
      continue;
    }
    double squared_length = 0.0;
    for_each_block(batch, [&](int i, int n) {
      differences(positions, i, batch.offset, n, l);
      for (int s = 0; s < n; ++s)
      {
        squared_length = std::max(squared_length, l.x[s] * l.x[s] + l.y[s] * l.y[s] + l.z[s] * l.z[s]);
      }
    });
    largest = std::max(largest, std::sqrt(squared_length) / batch.rest_length - 1.0);
  }
  return largest;
}

void add_stiffness_product(const ClothModel& model, const Vectors& positions, const Vectors& displacements,
                           Vectors& product)
{
  Block l;
  Block u;
  for (const SpringBatch& batch : model.springs)
  {
    for_each_block(batch, [&](int i, int n) {
      differences(positions, i, batch.offset, n, l);
      differences(displacements, i, batch.offset, n, u);
      for (int s = 0; s < n; ++s)
      {
        const double inverse = inverse_length(l.x[s], l.y[s], l.z[s]);
        const double across = batch.stiffness * std::max(0.0, 1.0 - batch.rest_length * inverse);
        const double along =
            (batch.stiffness - across) * inverse * inverse * (l.x[s] * u.x[s] + l.y[s] * u.y[s] + l.z[s] * u.z[s]);
        u.x[s] = -(across * u.x[s] + along * l.x[s]);
        u.y[s] = -(across * u.y[s] + along * l.y[s]);
        u.z[s] = -(across * u.z[s] + along * l.z[s]);
      }
      add_to_both_ends(u, i, batch.offset, n, product);
    });
  }
}

}  // namespace cloth
