#include "spring_tensions.h"

#include <algorithm>
#include <cmath>

#include "cloth_sim/model/inverse_root.h"
#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/spring_rows.h"
#include "cloth_sim/model/wide_vectors.h"

namespace cloth
{
namespace
{

using Tensions = std::array<double*, 3>;

/// Of a spring, over that of its ends' masses: only the choice of the first guess knows of it.
constexpr double compliance = 1e-4;

/// Gives the chosen springs the tension that is right if all others' are, and moves their ends by the change. Returns
/// whether any of them is taut.
template <bool fused, typename IsChosen>
bool relax(const SpringRow& row, const Tensions& tensions, double longest, IsChosen&& is_chosen)
{
  RowChanges changes;
  const double squared = longest * longest;
  std::int64_t taut = 0;
  const double* const w_i = row.w_i;
  const double* const w_j = row.w_j;
  const double* const x_i = row.i[0];
  const double* const y_i = row.i[1];
  const double* const z_i = row.i[2];
  const double* const x_j = row.j[0];
  const double* const y_j = row.j[1];
  const double* const z_j = row.j[2];
  double* const p_x = tensions[0];
  double* const p_y = tensions[1];
  double* const p_z = tensions[2];
  const int n = row.n;
  const int padded = row.padded;
#pragma GCC ivdep
  for (int k = 0; k < padded; ++k)
  {
    const double w = w_i[k] + w_j[k];
    const double x = x_j[k] - x_i[k] + w * p_x[k];
    const double y = y_j[k] - y_i[k] + w * p_y[k];
    const double z = z_j[k] - z_i[k] + w * p_z[k];
    const double square = x * x + y * y + z * z;
    const bool is_looked_at = is_chosen(k) && k < n;
    const bool is_taut = square > squared && w > 0.0;
    const double part = is_taut ? (1.0 - longest * inverse_root<fused>(square)) / w : 0.0;
    changes.x[k] = is_looked_at ? part * x - p_x[k] : 0.0;
    changes.y[k] = is_looked_at ? part * y - p_y[k] : 0.0;
    changes.z[k] = is_looked_at ? part * z - p_z[k] : 0.0;
    p_x[k] += changes.x[k];
    p_y[k] += changes.y[k];
    p_z[k] += changes.z[k];
    taut |= is_looked_at && is_taut ? 1 : 0;
  }
  move_ends(row, changes);
  return taut != 0;
}

/// The dual objective along tensions that are multiplied by t is rise t - curvature t^2/2.
struct DualParabola
{
  double rise = 0.0;
  double curvature = 0.0;
};

/// Adds to the shifts of nodes what their springs' tensions p ask for, and to the parabola the sum of p . l - |p|
/// longest, l being the springs at their positions, and of the compliance times (1/m_i + 1/m_j) |p|^2.
template <bool fused>
void add_shifts(const SpringRow& positions, const Tensions& tensions, double longest, const SpringRow& shifts,
                DualParabola& parabola)
{
  RowChanges pulls;
  const double* const x_i = positions.i[0];
  const double* const y_i = positions.i[1];
  const double* const z_i = positions.i[2];
  const double* const x_j = positions.j[0];
  const double* const y_j = positions.j[1];
  const double* const z_j = positions.j[2];
  const double* const p_x = tensions[0];
  const double* const p_y = tensions[1];
  const double* const p_z = tensions[2];
  const int n = positions.n;
  const int padded = positions.padded;
  const double* const w_i = positions.w_i;
  const double* const w_j = positions.w_j;
  double rise = 0.0;
  double squares = 0.0;
  for (int k = 0; k < padded; ++k)
  {
    const double x = k < n ? p_x[k] : 0.0;
    const double y = k < n ? p_y[k] : 0.0;
    const double z = k < n ? p_z[k] : 0.0;
    const double square = x * x + y * y + z * z;
    rise += x * (x_j[k] - x_i[k]) + y * (y_j[k] - y_i[k]) + z * (z_j[k] - z_i[k]) -
            longest * square * inverse_root<fused>(square);
    squares += (w_i[k] + w_j[k]) * square;
    pulls.x[k] = x;
    pulls.y[k] = y;
    pulls.z[k] = z;
  }
  move_ends(shifts, pulls);
  parabola.rise += rise;
  parabola.curvature += compliance * squares;
}

/// How long the springs between two stretches of n nodes are, given the squares of the lengths from which on one that
/// is not held at both ends is taut, and too long.
SpringTensions::Lengths lengths_of(const SpringRow& row, double taut, double too_long)
{
  const double* const w_i = row.w_i;
  const double* const w_j = row.w_j;
  const double* const x_i = row.i[0];
  const double* const y_i = row.i[1];
  const double* const z_i = row.i[2];
  const double* const x_j = row.j[0];
  const double* const y_j = row.j[1];
  const double* const z_j = row.j[2];
  const int n = row.n;
  const int padded = row.padded;
  std::int64_t any_taut = 0;
  std::int64_t any_too_long = 0;
  for (int k = 0; k < padded; ++k)
  {
    const double x = x_j[k] - x_i[k];
    const double y = y_j[k] - y_i[k];
    const double z = z_j[k] - z_i[k];
    const double square = x * x + y * y + z * z;
    const bool counts = w_i[k] + w_j[k] > 0.0 && k < n;
    any_taut |= counts && square > taut ? 1 : 0;
    any_too_long |= counts && square > too_long ? 1 : 0;
  }
  using Lengths = SpringTensions::Lengths;
  return any_too_long != 0 ? Lengths::too_long : any_taut != 0 ? Lengths::taut : Lengths::slack;
}

}  // namespace

SpringTensions::SpringTensions(const ClothModel& model)
  : rows_(model.rows), moved_at_(static_cast<size_t>(model.nodes() / spring_row_size + 1), 0)
{
  for (const SpringBatch& springs : limited_batches(model))
  {
    const int blocks_a_row = (springs.cols + spring_row_size - 1) / spring_row_size;
    const std::vector<double> none(static_cast<size_t>(springs.size() + row_padding), 0.0);
    const size_t blocks = static_cast<size_t>(springs.rows * blocks_a_row);
    batches_.push_back(
        { springs, blocks_a_row, { none, none, none }, std::vector<char>(blocks, 0), std::vector<long>(blocks, -1) });
  }
}

template <typename Visit>
void SpringTensions::for_each_block(bool backwards, Visit&& visit)
{
  for (int r = 0; r < rows_; ++r)
  {
    const int row = backwards ? rows_ - 1 - r : r;
    for (Batch& batch : batches_)
    {
      if (row >= batch.springs.rows)
      {
        continue;
      }
      for (int b = 0; b < batch.blocks_a_row; ++b)
      {
        const int block = backwards ? batch.blocks_a_row - 1 - b : b;
        const int done = block * spring_row_size;
        visit(batch, Block{ static_cast<size_t>(row * batch.blocks_a_row + block), row * batch.springs.cols + done,
                            batch.springs.first + row * batch.springs.row_stride + done,
                            std::min(spring_row_size, batch.springs.cols - done) });
      }
    }
  }
}

void SpringTensions::go_on_from(const Shortening& before)
{
  const auto* const other = dynamic_cast<const SpringTensions*>(&before);
  if (other == nullptr)
  {
    return;
  }
  reached_ = other->reached_;
  margin_ = other->margin_;
  for (Batch& batch : batches_)
  {
    const auto same = std::find_if(other->batches_.begin(), other->batches_.end(), [&](const Batch& candidate) {
      return candidate.springs.first == batch.springs.first && candidate.springs.offset == batch.springs.offset;
    });
    if (same != other->batches_.end())
    {
      std::copy(std::begin(same->tensions), std::end(same->tensions), std::begin(batch.tensions));
      batch.is_taut = same->is_taut;
    }
  }
}

StrainLimit::Report SpringTensions::shorten(const Eigen::VectorXd& inverse_masses, double max_strain, int passes,
                                            Vectors& positions, Vectors* shifts)
{
  max_strain_ = max_strain;
  ++now_;
  std::fill(moved_at_.begin(), moved_at_.end(), now_);
  StrainLimit::Report report;
  report.moved = pull_as_before(inverse_masses, positions);
  Lengths longest = find_taut_blocks(inverse_masses, positions);
  for (bool goes_on = report.moved || longest != Lengths::slack; goes_on; goes_on = longest == Lengths::too_long)
  {
    if (report.sweeps >= passes)
    {
      report.reached = false;
      break;
    }
    relax_taut_blocks(report.sweeps % 2 == 1, inverse_masses, positions);
    report.moved = true;
    ++report.sweeps;
    longest = find_taut_blocks(inverse_masses, positions);
  }
  if (shifts != nullptr)
  {
    add_tensions_to(*shifts);
  }
  reached_ = report.reached;
  margin_ = std::clamp(margin_ * (report.sweeps > few ? margin_growth : margin_decay), StrainLimit::least_margin,
                       StrainLimit::most_margin);
  return report;
}

std::array<double*, 3> SpringTensions::tensions_of(Batch& batch, const Block& block)
{
  return { batch.tensions[0].data() + block.first, batch.tensions[1].data() + block.first,
           batch.tensions[2].data() + block.first };
}

double SpringTensions::target_length(const Batch& batch) const
{
  return batch.springs.rest_length * (1.0 + max_strain_ * (1.0 - margin_));
}

// The dual objective, sum of p . l - |p| l_max less half the sum of m |shift|^2, is 0 without tensions; along the
// tensions of the last step it is highest where they are multiplied by the factor below. Tensions that shift nothing,
// because they hold each other or pull on pins alone, would be multiplied for ever were springs not thought to give way
// a little at this point.
bool SpringTensions::pull_as_before(const Eigen::VectorXd& inverse_masses, Vectors& positions)
{
  shifts_.setZero(positions.rows(), 3);
  DualParabola parabola;
  in_widest_vectors([&](auto arithmetic) {
    for_each_block(false, [&](Batch& batch, const Block& block) {
      if (batch.is_taut[block.index])
      {
        const int offset = batch.springs.offset;
        const double* const w = inverse_masses.data();
        add_shifts<arithmetic.has_fused_multiply_add>(SpringRow(w, positions, block.node, offset, block.n),
                                                      tensions_of(batch, block), target_length(batch),
                                                      SpringRow(w, shifts_, block.node, offset, block.n), parabola);
      }
    });
  });
  const auto squares = shifts_.rowwise().squaredNorm().array();
  parabola.curvature += (inverse_masses.array() > 0.0).select(squares / inverse_masses.array(), 0.0).sum();
  if (!(parabola.rise > 0.0 && parabola.curvature > 0.0))
  {
    let_go();
    return false;
  }
  const double factor = std::min(parabola.rise / parabola.curvature, reached_ ? most_growth : most_growth_of_a_failure);
  scale_tensions(factor);
  positions += factor * shifts_;
  return true;
}

void SpringTensions::add_tensions_to(Vectors& shifts)
{
  for_each_block(false, [&](Batch& batch, const Block& block) {
    for (int k = 0; batch.is_taut[block.index] && k < block.n; ++k)
    {
      const size_t spring = static_cast<size_t>(block.first + k);
      const Eigen::RowVector3d tension(batch.tensions[0][spring], batch.tensions[1][spring], batch.tensions[2][spring]);
      shifts.row(block.node + k) += tension;
      shifts.row(block.node + k + batch.springs.offset) -= tension;
    }
  });
}

void SpringTensions::let_go()
{
  for (Batch& batch : batches_)
  {
    for (std::vector<double>& tensions : batch.tensions)
    {
      std::fill(tensions.begin(), tensions.end(), 0.0);
    }
    std::fill(batch.is_taut.begin(), batch.is_taut.end(), 0);
  }
}

void SpringTensions::scale_tensions(double factor)
{
  for_each_block(false, [&](Batch& batch, const Block& block) {
    if (batch.is_taut[block.index])
    {
      for (std::vector<double>& tensions : batch.tensions)
      {
        double* const p = tensions.data() + block.first;
        for (int k = 0; k < block.n; ++k)
        {
          p[k] *= factor;
        }
      }
    }
  });
}

SpringTensions::Lengths SpringTensions::find_taut_blocks(const Eigen::VectorXd& inverse_masses, Vectors& positions)
{
  ++part_calls()[Part::strain_watch];
  Lengths longest = Lengths::slack;
  in_widest_vectors([&](auto) {
    for_each_block(false, [&](Batch& batch, const Block& block) {
      long& found_slack = batch.found_slack_at[block.index];
      if (last_move(block.node, block.n) <= found_slack &&
          last_move(block.node + batch.springs.offset, block.n) <= found_slack)
      {
        return;
      }
      const double taut = target_length(batch);
      const double too_long = batch.springs.rest_length * (1.0 + max_strain_ * (1.0 + StrainLimit::tolerance));
      const SpringRow row(inverse_masses.data(), positions, block.node, batch.springs.offset, block.n);
      const Lengths found = lengths_of(row, taut * taut, too_long * too_long);
      longest = std::max(longest, found);
      if (found == Lengths::slack)
      {
        found_slack = now_;
      }
      else
      {
        batch.is_taut[block.index] = 1;
      }
    });
  });
  return longest;
}

void SpringTensions::relax_taut_blocks(bool backwards, const Eigen::VectorXd& inverse_masses, Vectors& positions)
{
  ++part_calls()[Part::strain_limit];
  ++now_;
  in_widest_vectors([&](auto arithmetic) {
    constexpr bool fused = arithmetic.has_fused_multiply_add;
    for_each_block(backwards, [&](Batch& batch, const Block& block) {
      if (!batch.is_taut[block.index])
      {
        return;
      }
      const double longest = target_length(batch);
      const SpringRow row(inverse_masses.data(), positions, block.node, batch.springs.offset, block.n);
      const Tensions tensions = tensions_of(batch, block);
      bool is_taut = false;
      in_turns(batch.springs.offset, block.n,
               [&](auto&& is_chosen) { is_taut |= relax<fused>(row, tensions, longest, is_chosen); });
      batch.is_taut[block.index] = is_taut ? 1 : 0;
      mark_moved(block.node, block.n);
      mark_moved(block.node + batch.springs.offset, block.n);
    });
  });
}

void SpringTensions::mark_moved(int node, int n)
{
  for (int block = node / spring_row_size; block <= (node + n - 1) / spring_row_size; ++block)
  {
    moved_at_[static_cast<size_t>(block)] = now_;
  }
}

long SpringTensions::last_move(int node, int n) const
{
  return std::max(moved_at_[static_cast<size_t>(node / spring_row_size)],
                  moved_at_[static_cast<size_t>((node + n - 1) / spring_row_size)]);
}

}  // namespace cloth
