#include "multigrid.h"

#include "cloth_sim/model/wide_vectors.h"

namespace cloth
{
namespace
{

bool is_coarsest(const GridMatrix& matrix)
{
  return std::max(matrix.rows(), matrix.cols()) <= Halving::fewest;
}

/// x += B r for the nodes of a row, B having six components and x and r three, `pitch` apart.
template <bool adds>
void apply_blocks(const double* b, const double* r, double* x, int pitch)
{
  const int n = pitch & ~7;
#pragma GCC ivdep
  for (int s = 0; s < n; ++s)
  {
    const double r_x = r[s];
    const double r_y = r[pitch + s];
    const double r_z = r[2 * pitch + s];
    const double x_x = b[s] * r_x + b[3 * pitch + s] * r_y + b[4 * pitch + s] * r_z;
    const double x_y = b[3 * pitch + s] * r_x + b[pitch + s] * r_y + b[5 * pitch + s] * r_z;
    const double x_z = b[4 * pitch + s] * r_x + b[5 * pitch + s] * r_y + b[2 * pitch + s] * r_z;
    x[s] = (adds ? x[s] : 0.0) + x_x;
    x[pitch + s] = (adds ? x[pitch + s] : 0.0) + x_y;
    x[2 * pitch + s] = (adds ? x[2 * pitch + s] : 0.0) + x_z;
  }
}

}  // namespace

Multigrid::Level::Level(int rows, int cols)
  : matrix(rows, cols)
  , inverses(rows, cols, GridMatrix::values_a_block)
  , right(rows, cols, 3)
  , solution(rows, cols, 3)
  , remainder(rows, cols, 3)
  , halved(Halving{ rows }.coarse(), cols)
{
}

void Multigrid::make_levels(const ClothModel& model)
{
  if (!levels_.empty() && levels_.front().matrix.rows() == model.rows && levels_.front().matrix.cols() == model.cols)
  {
    return;
  }
  levels_.clear();
  levels_.emplace_back(model.rows, model.cols);
  while (!is_coarsest(levels_.back().matrix))
  {
    const GridMatrix& finer = levels_.back().matrix;
    levels_.emplace_back(Halving{ finer.rows() }.coarse(), Halving{ finer.cols() }.coarse());
  }
}

void Multigrid::prepare(const ClothModel& model, const Pins& pins, const Eigen::ArrayXd& diagonal,
                        const SpringJacobian& springs)
{
  make_levels(model);
  masses_ = model.masses;
  held_.clear();
  for (const Pin& pin : pins.all())
  {
    held_.insert(held_.end(), pin.nodes.begin(), pin.nodes.end());
  }
  levels_.front().matrix.fill(model, pins, diagonal, springs);
  for (size_t l = 0; l < levels_.size(); ++l)
  {
    if (l > 0)
    {
      levels_[l - 1].halved.fill_by_halving_rows(levels_[l - 1].matrix);
      levels_[l].matrix.fill_by_halving_cols(levels_[l - 1].halved);
    }
    levels_[l].matrix.invert_centres(relaxation, levels_[l].inverses);
  }
  coarsest_.compute(levels_.back().matrix.dense());
}

void Multigrid::apply(const Vectors& r, Vectors& z)
{
  const bool is_free = held_.empty();
  const double mass = masses_.sum();
  const Eigen::RowVector3d mean = r.colwise().sum() / mass;
  Level& finest = levels_.front();
  const int cols = finest.matrix.cols();
  for (int row = 0; row < finest.matrix.rows(); ++row)
  {
    for (int d = 0; d < 3; ++d)
    {
      double* const to = finest.right.row(row, d);
      const double* const from = r.col(d).data() + row * cols;
      const double* const masses = masses_.data() + row * cols;
      const double taken = is_free ? mean[d] : 0.0;
      for (int c = 0; c < cols; ++c)
      {
        to[c] = from[c] - taken * masses[c];
      }
    }
  }
  improve(0);
  z.resize(r.rows(), 3);
  for (int row = 0; row < finest.matrix.rows(); ++row)
  {
    for (int d = 0; d < 3; ++d)
    {
      const double* const from = finest.solution.row(row, d);
      std::copy(from, from + cols, z.col(d).data() + row * cols);
    }
  }
  for (const int node : held_)
  {
    z.row(node).setZero();
  }
  if (is_free)
  {
    const Eigen::RowVector3d missing = mean - masses_.transpose() * z / mass;
    z.rowwise() += missing;
  }
}

void Multigrid::improve(size_t level)
{
  Level& here = levels_[level];
  if (level + 1 == levels_.size())
  {
    solve_coarsest();
    return;
  }
  start(here);
  find_remainder(here);
  restrict_remainder(here, levels_[level + 1]);
  improve(level + 1);
  add_correction(levels_[level + 1], here);
  find_remainder(here);
  relax(here);
}

void Multigrid::solve_coarsest()
{
  Level& level = levels_.back();
  const int cols = level.matrix.cols();
  Eigen::VectorXd values(3 * level.matrix.rows() * cols);
  for (int i = 0; i < values.size(); ++i)
  {
    values[i] = level.right.row(i / 3 / cols, i % 3)[i / 3 % cols];
  }
  coarsest_.solveInPlace(values);
  for (int i = 0; i < values.size(); ++i)
  {
    level.solution.row(i / 3 / cols, i % 3)[i / 3 % cols] = values[i];
  }
}

void Multigrid::start(Level& level)
{
  in_widest_vectors([&](auto) {
    for (int r = 0; r < level.matrix.rows(); ++r)
    {
      apply_blocks<false>(level.inverses.row(r), level.right.row(r), level.solution.row(r), level.right.pitch());
    }
  });
}

void Multigrid::find_remainder(Level& level)
{
  level.remainder = level.right;
  level.matrix.subtract_product(level.solution, level.remainder);
}

void Multigrid::relax(Level& level)
{
  in_widest_vectors([&](auto) {
    for (int r = 0; r < level.matrix.rows(); ++r)
    {
      apply_blocks<true>(level.inverses.row(r), level.remainder.row(r), level.solution.row(r), level.right.pitch());
    }
  });
}

void Multigrid::restrict_remainder(Level& fine, Level& coarse)
{
  const Halving down{ fine.matrix.rows() };
  const Halving across{ fine.matrix.cols() };
  const int n = 3 * fine.remainder.pitch();
  for (int r = 0; r < coarse.matrix.rows(); ++r)
  {
    // The row's sums are put where the row was, which nobody needs any more.
    double* const sums = fine.remainder.row(down.node(r));
    for (const int between : { down.has_between(r - 1) ? -1 : 0, down.has_between(r) ? 1 : 0 })
    {
      const double* const row = fine.remainder.row(down.node(r) + between);
      for (int s = 0; between != 0 && s < n; ++s)
      {
        sums[s] += 0.5 * row[s];
      }
    }
    for (int d = 0; d < 3; ++d)
    {
      const double* const from = sums + d * fine.remainder.pitch();
      double* const to = coarse.right.row(r, d);
      for (int c = 0; c < coarse.matrix.cols(); ++c)
      {
        const int f = across.node(c);
        to[c] = from[f] + (across.has_between(c - 1) ? 0.5 * from[f - 1] : 0.0) +
                (across.has_between(c) ? 0.5 * from[f + 1] : 0.0);
      }
    }
  }
}

void Multigrid::add_correction(const Level& coarse, Level& fine)
{
  const Halving down{ fine.matrix.rows() };
  const Halving across{ fine.matrix.cols() };
  const auto add_row = [&](int from_row, double factor, int to_row) {
    for (int d = 0; d < 3; ++d)
    {
      const double* const from = coarse.solution.row(from_row, d);
      double* const to = fine.solution.row(to_row, d);
      for (int c = 0; c < coarse.matrix.cols(); ++c)
      {
        const int f = across.node(c);
        to[f] += factor * from[c];
        if (across.has_between(c))
        {
          to[f + 1] += 0.5 * factor * (from[c] + from[c + 1]);
        }
      }
    }
  };
  for (int r = 0; r < coarse.matrix.rows(); ++r)
  {
    const int f = down.node(r);
    add_row(r, 1.0, f);
    if (down.has_between(r))
    {
      add_row(r, 0.5, f + 1);
      add_row(r + 1, 0.5, f + 1);
    }
  }
}

}  // namespace cloth
