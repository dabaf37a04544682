#include "grid_matrix.h"

#include "cloth_sim/model/wide_vectors.h"

namespace cloth
{
namespace
{

constexpr int xx = 0;
constexpr int yy = 1;
constexpr int zz = 2;
constexpr int xy = 3;
constexpr int xz = 4;
constexpr int yz = 5;

/// sums[s] += factor * added[s]
inline void add(double factor, const double* added, double* sums, int n)
{
#pragma GCC ivdep
  for (int s = 0; s < n; ++s)
  {
    sums[s] += factor * added[s];
  }
}

/// Subtracts the blocks' products with `u` from `vectors`: n nodes of a row, all components of which are `pitch` apart.
inline void subtract_products(const double* blocks, const double* u, double* vectors, int pitch)
{
  const double* const b_xx = blocks + xx * pitch;
  const double* const b_yy = blocks + yy * pitch;
  const double* const b_zz = blocks + zz * pitch;
  const double* const b_xy = blocks + xy * pitch;
  const double* const b_xz = blocks + xz * pitch;
  const double* const b_yz = blocks + yz * pitch;
  const double* const u_x = u;
  const double* const u_y = u + pitch;
  const double* const u_z = u + 2 * pitch;
  double* const x = vectors;
  double* const y = vectors + pitch;
  double* const z = vectors + 2 * pitch;
  const int n = pitch & ~7;  // it is a whole number of vectors, which the compiler cannot know
#pragma GCC ivdep
  for (int s = 0; s < n; ++s)
  {
    x[s] -= b_xx[s] * u_x[s] + b_xy[s] * u_y[s] + b_xz[s] * u_z[s];
    y[s] -= b_xy[s] * u_x[s] + b_yy[s] * u_y[s] + b_yz[s] * u_z[s];
    z[s] -= b_xz[s] * u_x[s] + b_yz[s] * u_y[s] + b_zz[s] * u_z[s];
  }
}

/// blocks[s] += factor * weights[s] * (across[s] I + w[s] w[s]^T), components `pitch` apart.
template <typename Weights>
inline void add_blocks(double factor, const Weights& weights, const double* across, const double* w_x,
                       const double* w_y, const double* w_z, double* blocks, int pitch, int n)
{
  double* const b_xx = blocks + xx * pitch;
  double* const b_yy = blocks + yy * pitch;
  double* const b_zz = blocks + zz * pitch;
  double* const b_xy = blocks + xy * pitch;
  double* const b_xz = blocks + xz * pitch;
  double* const b_yz = blocks + yz * pitch;
#pragma GCC ivdep
  for (int s = 0; s < n; ++s)
  {
    const double weight = factor * weights(s);
    b_xx[s] += weight * (across[s] + w_x[s] * w_x[s]);
    b_yy[s] += weight * (across[s] + w_y[s] * w_y[s]);
    b_zz[s] += weight * (across[s] + w_z[s] * w_z[s]);
    b_xy[s] += weight * (w_x[s] * w_y[s]);
    b_xz[s] += weight * (w_x[s] * w_z[s]);
    b_yz[s] += weight * (w_y[s] * w_z[s]);
  }
}

}  // namespace

GridArray::GridArray(int rows, int cols, int components)
  : rows_(rows)
  , cols_(cols)
  , components_(components)
  , pitch_((cols / widest + 1) * widest)
  , values_(place(rows + 1, 0) + widest, 0.0)
{
}

GridMatrix::GridMatrix(int rows, int cols) : blocks_(rows, cols, neighbours * values_a_block)
{
}

void GridMatrix::fill(const ClothModel& model, const Pins& pins, const Eigen::ArrayXd& diagonal,
                      const SpringJacobian& springs)
{
  blocks_.clear();
  free_.resize(static_cast<size_t>(model.nodes()));
  for (int i = 0; i < model.nodes(); ++i)
  {
    const double is_free = pins.holds(i) ? 0.0 : 1.0;
    free_[static_cast<size_t>(i)] = is_free;
    for (const int component : { xx, yy, zz })
    {
      block_row(model.row_of(i), centre)[component * blocks_.pitch() + model.col_of(i)] = is_free * diagonal[i];
    }
  }
  for (const SpringJacobian::LinearisedBatch& linearised : springs.batches())
  {
    const SpringBatch& batch = linearised.batch;
    switch (batch.kind)
    {
      case SpringKind::structural:
        add_springs(linearised, 0, 1.0, batch.offset == 1 ? east : south);
        break;
      case SpringKind::shear:
        add_springs(linearised, 0, 1.0, batch.offset > model.cols ? south_east : south_west);
        break;
      case SpringKind::flex:
        for (const int from : { 0, batch.offset / 2 })
        {
          add_springs(linearised, from, 2.0, batch.offset == 2 ? east : south);
        }
        break;
    }
  }
}

GridMatrix::Way GridMatrix::way_to(Neighbour neighbour)
{
  constexpr Way ways[neighbours] = { { 0, 0 }, { 0, 1 }, { 1, 0 }, { 1, 1 }, { 1, -1 } };
  return ways[neighbour];
}

/// The springs of a batch, each from its first end and `from` nodes further on, to a neighbour.
void GridMatrix::add_springs(const SpringJacobian::LinearisedBatch& linearised, int from, double factor,
                             Neighbour neighbour)
{
  const SpringBatch& batch = linearised.batch;
  const int pitch = blocks_.pitch();
  const Way way = way_to(neighbour);
  in_widest_vectors([&](auto) {
    int n = 0;
    for (int done = 0; done < batch.size(); done += n)
    {
      const int i = batch.first + done / batch.cols * batch.row_stride + done % batch.cols + from;
      const int row = i / cols();
      const int col = i % cols();
      n = std::min(batch.cols - done % batch.cols, cols() - col);  // rows of springs may go on over rows of nodes
      const double* const across = linearised.across.data() + done;
      const double* const w_x = linearised.w_x.data() + done;
      const double* const w_y = linearised.w_y.data() + done;
      const double* const w_z = linearised.w_z.data() + done;
      const double* const first = free_.data() + i;
      const double* const second = first + way.down * cols() + way.across;
      const auto weight_of_first = [first](int s) { return first[s]; };
      const auto weight_of_second = [second](int s) { return second[s]; };
      const auto weight_of_both = [first, second](int s) { return first[s] * second[s]; };
      double* const centres = block_row(row, centre) + col;
      double* const centres_of_ends = block_row(row + way.down, centre) + col + way.across;
      add_blocks(factor, weight_of_first, across, w_x, w_y, w_z, centres, pitch, n);
      add_blocks(factor, weight_of_second, across, w_x, w_y, w_z, centres_of_ends, pitch, n);
      add_blocks(-factor, weight_of_both, across, w_x, w_y, w_z, block_row(row, neighbour) + col, pitch, n);
    }
  });
}

void GridMatrix::fill_by_halving_rows(const GridMatrix& finer)
{
  const Halving halving{ finer.rows() };
  const int n = values_a_block * blocks_.pitch();
  blocks_.clear();
  in_widest_vectors([&](auto) {
    for (int r = 0; r < rows(); ++r)
    {
      const int f = halving.node(r);
      const auto fine = [&](int row, Neighbour neighbour) { return finer.block_row(row, neighbour); };
      const auto put = [&](Neighbour neighbour, double factor, const double* added) {
        add(factor, added, block_row(r, neighbour), n);
      };
      put(centre, 1.0, fine(f, centre));
      put(east, 1.0, fine(f, east));
      if (halving.has_between(r - 1))
      {
        put(centre, 0.25, fine(f - 1, centre));
        put(centre, 1.0, fine(f - 1, south));
        put(east, 0.25, fine(f - 1, east));
        put(east, 0.5, fine(f - 1, south_east));
        put(east, 0.5, fine(f - 1, south_west) + 1);
      }
      const bool has_between = halving.has_between(r);
      if (has_between)
      {
        put(centre, 0.25, fine(f + 1, centre));
        put(centre, 1.0, fine(f, south));
        put(east, 0.25, fine(f + 1, east));
        put(east, 0.5, fine(f, south_east));
        put(east, 0.5, fine(f, south_west) + 1);
        put(south, 0.25, fine(f + 1, centre));
        put(south_east, 0.25, fine(f + 1, east));
        put(south_west, 0.25, fine(f + 1, east) - 1);
      }
      for (const Neighbour neighbour : { south, south_east, south_west })
      {
        put(neighbour, has_between ? 0.5 : 1.0, fine(f, neighbour));
        if (has_between)
        {
          put(neighbour, 0.5, fine(f + 1, neighbour));
        }
      }
      for (int component = 0; component < values_a_block; ++component)
      {
        // A value from the next component's row.
        double* const values = block_row(r, east) + component * blocks_.pitch();
        std::fill(values + cols(), values + blocks_.pitch(), 0.0);
      }
    }
  });
}

void GridMatrix::fill_by_halving_cols(const GridMatrix& finer)
{
  const Halving halving{ finer.cols() };
  for (int r = 0; r < rows(); ++r)
  {
    for (int component = 0; component < values_a_block; ++component)
    {
      const auto fine = [&](Neighbour neighbour) {
        return finer.block_row(r, neighbour) + component * finer.blocks_.pitch();
      };
      const double* const f_centre = fine(centre);
      const double* const f_east = fine(east);
      const double* const f_south = fine(south);
      const double* const f_south_east = fine(south_east);
      const double* const f_south_west = fine(south_west);
      const auto coarse = [&](Neighbour neighbour) { return block_row(r, neighbour) + component * blocks_.pitch(); };
      for (int c = 0; c < cols(); ++c)
      {
        const int f = halving.node(c);
        double of_centre = f_centre[f];
        double of_east = f_east[f];
        double of_south = f_south[f];
        double of_south_east = f_south_east[f];
        double of_south_west = f_south_west[f];
        if (halving.has_between(c - 1))
        {
          of_centre += 0.25 * f_centre[f - 1] + f_east[f - 1];
          of_south += 0.25 * f_south[f - 1] + 0.5 * (f_south_east[f - 1] + f_south_west[f]);
          of_south_west = 0.5 * (f_south_west[f] + f_south_west[f - 1]) + 0.25 * f_south[f - 1];
        }
        if (halving.has_between(c))
        {
          of_centre += 0.25 * f_centre[f + 1] + f_east[f];
          of_east = 0.5 * (f_east[f] + f_east[f + 1]) + 0.25 * f_centre[f + 1];
          of_south += 0.25 * f_south[f + 1] + 0.5 * (f_south_east[f] + f_south_west[f + 1]);
          of_south_east = 0.5 * (f_south_east[f] + f_south_east[f + 1]) + 0.25 * f_south[f + 1];
        }
        coarse(centre)[c] = of_centre;
        coarse(east)[c] = of_east;
        coarse(south)[c] = of_south;
        coarse(south_east)[c] = of_south_east;
        coarse(south_west)[c] = of_south_west;
      }
    }
  }
}

void GridMatrix::subtract_product(const GridArray& u, GridArray& vectors) const
{
  in_widest_vectors([&](auto) {
    const int pitch = blocks_.pitch();
    for (int r = 0; r < rows(); ++r)
    {
      double* const sums = vectors.row(r);
      subtract_products(block_row(r, centre), u.row(r), sums, pitch);
      subtract_products(block_row(r, east), u.row(r) + 1, sums, pitch);
      subtract_products(block_row(r, east) - 1, u.row(r) - 1, sums, pitch);
      subtract_products(block_row(r, south), u.row(r + 1), sums, pitch);
      subtract_products(block_row(r - 1, south), u.row(r - 1), sums, pitch);
      subtract_products(block_row(r, south_east), u.row(r + 1) + 1, sums, pitch);
      subtract_products(block_row(r - 1, south_east) - 1, u.row(r - 1) - 1, sums, pitch);
      subtract_products(block_row(r, south_west), u.row(r + 1) - 1, sums, pitch);
      subtract_products(block_row(r - 1, south_west) + 1, u.row(r - 1) + 1, sums, pitch);
    }
  });
}

void GridMatrix::invert_centres(double factor, GridArray& inverses) const
{
  in_widest_vectors([&](auto) {
    const int pitch = blocks_.pitch();
    const int n = pitch & ~7;
    for (int r = 0; r < rows(); ++r)
    {
      const double* const a = block_row(r, centre);
      double* const inverse = inverses.row(r);
#pragma GCC ivdep
      for (int s = 0; s < n; ++s)
      {
        const double a_xx = a[xx * pitch + s];
        const double a_yy = a[yy * pitch + s];
        const double a_zz = a[zz * pitch + s];
        const double a_xy = a[xy * pitch + s];
        const double a_xz = a[xz * pitch + s];
        const double a_yz = a[yz * pitch + s];
        const double m_xx = a_yy * a_zz - a_yz * a_yz;
        const double m_xy = a_xz * a_yz - a_xy * a_zz;
        const double m_xz = a_xy * a_yz - a_xz * a_yy;
        const double determinant = a_xx * m_xx + a_xy * m_xy + a_xz * m_xz;
        const double scale = determinant == 0.0 ? 0.0 : factor / determinant;
        inverse[xx * pitch + s] = scale * m_xx;
        inverse[xy * pitch + s] = scale * m_xy;
        inverse[xz * pitch + s] = scale * m_xz;
        inverse[yy * pitch + s] = scale * (a_xx * a_zz - a_xz * a_xz);
        inverse[yz * pitch + s] = scale * (a_xy * a_xz - a_xx * a_yz);
        inverse[zz * pitch + s] = scale * (a_xx * a_yy - a_xy * a_xy);
      }
    }
  });
}

Eigen::MatrixXd GridMatrix::dense() const
{
  const int n = 3 * rows() * cols();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  const auto add_block = [&](int r, int c, Neighbour neighbour) {
    const Way way = way_to(neighbour);
    const int row = r + way.down;
    const int col = c + way.across;
    if (row >= rows() || col < 0 || col >= cols())
    {
      return;
    }
    const double* const a = block_row(r, neighbour) + c;
    const int p = blocks_.pitch();
    Eigen::Matrix3d block;
    block << a[xx * p], a[xy * p], a[xz * p], a[xy * p], a[yy * p], a[yz * p], a[xz * p], a[yz * p], a[zz * p];
    const int i = 3 * (r * cols() + c);
    const int j = 3 * (row * cols() + col);
    matrix.block<3, 3>(i, j) = block;
    matrix.block<3, 3>(j, i) = block;
  };
  for (int r = 0; r < rows(); ++r)
  {
    for (int c = 0; c < cols(); ++c)
    {
      for (const Neighbour neighbour : { centre, east, south, south_east, south_west })
      {
        add_block(r, c, neighbour);
      }
    }
  }
  for (int i = 0; i < n; ++i)
  {
    matrix(i, i) = matrix(i, i) == 0.0 ? 1.0 : matrix(i, i);
  }
  return matrix;
}

}  // namespace cloth
