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

void add_elastic_forces(const SpringBatch& batch, const Vectors& positions, Vectors& forces)
{
  const double k = batch.stiffness;
  const double l0 = batch.rest_length;
  Block force;
  for_each_block(batch, [&](int i, int n) {
    const Differences lengths(positions, i, batch.offset);
    for (int s = 0; s < n; ++s)
    {
      const Vector l = lengths[s];
      put(force, s, k - k * l0 * inverse_length(l), l);
    }
    add_to_both_ends(force, i, batch.offset, n, forces);
  });
}

void add_elastic_and_damping_forces(const SpringBatch& batch, const Vectors& positions, const Vectors& velocities,
                                    Vectors& forces)
{
  const double k = batch.stiffness;
  const double c = batch.damping;
  const double l0 = batch.rest_length;
  Block force;
  for_each_block(batch, [&](int i, int n) {
    const Differences lengths(positions, i, batch.offset);
    const Differences approaches(velocities, i, batch.offset);
    for (int s = 0; s < n; ++s)
    {
      const Vector l = lengths[s];
      const double inverse = inverse_length(l);
      put(force, s, k + (c * approaches[s].dot(l) * inverse - k * l0) * inverse, l);
    }
    add_to_both_ends(force, i, batch.offset, n, forces);
  });
}

/// Adds k [n n^T + a (I - n n^T)] (u_i - u_j), a the part of 1 - l0/|l| that `stiffness_across` lets through.
template <typename StiffnessAcross>
void add_product(const ClothModel& model, const Vectors& positions, const Vectors& displacements, Vectors& product,
                 StiffnessAcross&& stiffness_across)
{
  Block change;
  for (const SpringBatch& batch : model.springs)
  {
    for_each_block(batch, [&](int i, int n) {
      const Differences lengths(positions, i, batch.offset);
      const Differences approaches(displacements, i, batch.offset);
      for (int s = 0; s < n; ++s)
      {
        const Vector l = lengths[s];
        const Vector u = approaches[s];
        const double inverse = inverse_length(l);
        const double across = batch.stiffness * stiffness_across(1.0 - batch.rest_length * inverse);
        const double along = (batch.stiffness - across) * inverse * inverse * l.dot(u);
        change.x[s] = -(across * u.x + along * l.x);
        change.y[s] = -(across * u.y + along * l.y);
        change.z[s] = -(across * u.z + along * l.z);
      }
      add_to_both_ends(change, i, batch.offset, n, product);
    });
  }
}

}  // namespace

void add_spring_forces(const ClothModel& model, const Vectors& positions, const Vectors& velocities, Vectors& forces)
{
  for (const SpringBatch& batch : model.springs)
  {
    if (batch.damping == 0.0)
    {
      add_elastic_forces(batch, positions, forces);
    }
    else
    {
      add_elastic_and_damping_forces(batch, positions, velocities, forces);
    }
  }
}

double elastic_energy(const ClothModel& model, const Vectors& positions)
{
  double energy = 0.0;
  for (const SpringBatch& batch : model.springs)
  {
    double squares = 0.0;
    for_each_block(batch, [&](int i, int n) {
      const Differences lengths(positions, i, batch.offset);
      for (int s = 0; s < n; ++s)
      {
        const double extension = std::sqrt(lengths[s].dot(lengths[s])) - batch.rest_length;
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
  for (const SpringBatch& batch : model.springs)
  {
    if (batch.kind == SpringKind::flex)
    {
      continue;
    }
    double squared_length = 0.0;
    for_each_block(batch, [&](int i, int n) {
      const Differences lengths(positions, i, batch.offset);
      for (int s = 0; s < n; ++s)
      {
        squared_length = std::max(squared_length, lengths[s].dot(lengths[s]));
      }
    });
    largest = std::max(largest, std::sqrt(squared_length) / batch.rest_length - 1.0);
  }
  return largest;
}

void add_stiffness_product(const ClothModel& model, const Vectors& positions, const Vectors& displacements,
                           Vectors& product)
{
  add_product(model, positions, displacements, product, [](double across) { return std::max(0.0, across); });
}

void add_hessian_product(const ClothModel& model, const Vectors& positions, const Vectors& displacements,
                         Vectors& product)
{
  add_product(model, positions, displacements, product, [](double across) { return across; });
}

}  // namespace cloth
