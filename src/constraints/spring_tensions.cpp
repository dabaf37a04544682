#include "spring_tensions.h"

#include <algorithm>
#include <cstdint>

#include "cloth_sim/model/inverse_root.h"
#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/wide_vectors.h"

namespace cloth
{
namespace
{

/// Gives the chosen springs the tension that is right if all others' are, and moves their ends by the change. Returns
/// whether any of them is taut.
template <bool fused, typename IsChosen>
bool relax(const SpringRow& row, const Columns<double>& tensions, double longest, IsChosen&& is_chosen)
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
  const int padded = row.padded();
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

/// Adds to the shifts of nodes what their springs' tensions p ask for, and to the parabola the sum of p . l - |p|
/// longest, l being the springs at their positions, and of the compliance times (1/m_i + 1/m_j) |p|^2.
template <bool fused>
void add_shifts(const SpringRow& positions, const Columns<double>& tensions, double longest, const SpringRow& shifts,
                DualParabola<double>& parabola)
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
  const double* const w_i = positions.w_i;
  const double* const w_j = positions.w_j;
  const int n = positions.n;
  const int padded = positions.padded();
#pragma GCC ivdep
  for (int k = 0; k < padded; ++k)
  {
    const double x = k < n ? p_x[k] : 0.0;
    const double y = k < n ? p_y[k] : 0.0;
    const double z = k < n ? p_z[k] : 0.0;
    const double square = x * x + y * y + z * z;
    parabola.rise[k] += x * (x_j[k] - x_i[k]) + y * (y_j[k] - y_i[k]) + z * (z_j[k] - z_i[k]) -
                        longest * square * inverse_root<fused>(square);
    parabola.curvature[k] += DualParabola<double>::compliance * (w_i[k] + w_j[k]) * square;
    pulls.x[k] = x;
    pulls.y[k] = y;
    pulls.z[k] = z;
  }
  move_ends(shifts, pulls);
}

/// Whether any of the springs that are not held at both ends is longer than the length of this square.
bool has_longer(const SpringRow& row, double longest)
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
  const int padded = row.padded();
  std::int64_t any = 0;
  for (int k = 0; k < padded; ++k)
  {
    const double x = x_j[k] - x_i[k];
    const double y = y_j[k] - y_i[k];
    const double z = z_j[k] - z_i[k];
    any |= x * x + y * y + z * z > longest && w_i[k] + w_j[k] > 0.0 && k < n ? 1 : 0;
  }
  return any != 0;
}

/// Adds m |shift|^2 to the parabola's curvature. There is room for a whole number of vectors.
void add_masses(const double* inverse_masses, const Columns<double>& shifts, int nodes, DualParabola<double>& parabola)
{
  const double* const x = shifts[0];
  const double* const y = shifts[1];
  const double* const z = shifts[2];
  for (int begin = 0; begin < nodes; begin += lanes_of<double>)
  {
#pragma GCC ivdep
    for (int k = 0; k < lanes_of<double>; ++k)
    {
      const int i = begin + k;
      const double square = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
      parabola.curvature[k] += square > 0.0 ? square / inverse_masses[i] : 0.0;
    }
  }
}

SpringRow row_of(const SpringRun& springs, const double* inverse_masses, const Columns<double>& columns)
{
  return { inverse_masses, columns, springs.node, springs.offset, springs.n };
}

bool are_the_same(const SpringRun& a, const SpringRun& b)
{
  return a.node == b.node && a.offset == b.offset && a.n == b.n;
}

}  // namespace

SpringTensions::SpringTensions(const ClothModel& model)
  : batches_(limited_batches(model))
  , tethers_(model)
  , nodes_(model.nodes())
  , moved_at_(static_cast<size_t>(nodes_ / mark_size + 2), 0)
{
  int first = 0;
  for (const SpringRun& run : runs_by_rows(batches_, model.rows))
  {
    runs_.push_back({ run, first });
    first += (run.n + lanes_of<double> - 1) / lanes_of<double> * lanes_of<double>;
  }
  tensions_.set_zero(first);
  last_tensions_.set_zero(first);
  shifts_.set_zero(nodes_);
  last_positions_.set_zero(nodes_);
  begins_.set_zero(nodes_);
}

void SpringTensions::go_on_from(const Shortening& before)
{
  const auto* const other = dynamic_cast<const SpringTensions*>(&before);
  if (other == nullptr)
  {
    return;
  }
  reached_ = other->reached_;
  wanted_margin_ = other->wanted_margin_;
  margin_ = other->margin_;
  tethers_.go_on_from(other->tethers_);
  auto next = other->runs_.begin();
  for (Run& run : runs_)
  {
    const auto found = std::find_if(next, other->runs_.end(), [&run](const Run& candidate) {
      return are_the_same(candidate.springs, run.springs);
    });
    if (found == other->runs_.end())
    {
      continue;
    }
    next = found + 1;
    run.is_taut = found->is_taut;
    const Columns<double> tensions = tensions_.from(run.first);
    const Columns<const double> theirs = other->tensions_.from(found->first);
    for (size_t d = 0; d < 3; ++d)
    {
      std::copy_n(theirs[d], run.springs.n, tensions[d]);
    }
  }
}

StrainLimit::Report SpringTensions::shorten(const Eigen::VectorXd& inverse_masses, double max_strain, int passes,
                                            double h, Vectors& positions, Vectors* shifts)
{
  const double* const w = inverse_masses.data();
  const Columns<double> columns = columns_of(positions);
  max_strain_ = max_strain;
  ++now_;
  std::fill(moved_at_.begin(), moved_at_.end(), now_);
  tethers_.prepare(inverse_masses);
  StrainLimit::Report report;
  report.moved = pull_as_before(w, columns);
  Lengths longest = find_taut(w, columns);
  bool goes_on = report.moved || longest != Lengths::slack;
  while (goes_on)
  {
    if (report.sweeps >= passes)
    {
      report.reached = longest != Lengths::too_long;
      break;
    }
    if (momentum_.is_to_begin(report.sweeps))
    {
      begin_momentum(columns);
    }
    else if (momentum_.is_to_carry_on(report.sweeps))
    {
      carry_on_all(columns);
    }
    relax_taut(report.sweeps % 2 == 1, w, columns);
    report.moved = true;
    ++report.sweeps;
    longest = find_taut(w, columns);
    goes_on = longest == Lengths::too_long || (longest == Lengths::taut && report.sweeps < there_and_back);
  }
  reached_ = report.reached;
  wanted_margin_ = std::clamp(wanted_margin_ * (report.sweeps > there_and_back ? margin_growth : margin_decay),
                              StrainLimit::least_margin, StrainLimit::most_margin);
  margin_ += std::clamp(wanted_margin_ - margin_, -margin_speed * h, margin_speed * h);
  if (shifts != nullptr)
  {
    add_tensions_to(columns_of(*shifts));
  }
  return report;
}

double SpringTensions::stretch_held() const
{
  return 1.0 + max_strain_ * (1.0 - margin_);
}

double SpringTensions::target_length(const Run& run) const
{
  return batches_[run.springs.batch].rest_length * stretch_held();
}

bool SpringTensions::pull_as_before(const double* inverse_masses, const Columns<double>& positions)
{
  const Columns<double> shifts = shifts_.from(0);
  DualParabola<double> parabola;
  double factor = 0.0;
  in_widest_vectors([&](auto arithmetic) {
    constexpr bool fused = arithmetic.has_fused_multiply_add;
    for (double* const column : shifts)
    {
      std::fill_n(column, nodes_ + row_padding, 0.0);
    }
    for (const Run& run : runs_)
    {
      if (run.is_taut)
      {
        add_shifts<fused>(row_of(run.springs, inverse_masses, positions), tensions_.from(run.first), target_length(run),
                          row_of(run.springs, inverse_masses, shifts), parabola);
      }
    }
    tethers_.add_shifts(inverse_masses, positions, stretch_held(), shifts, parabola);
    add_masses(inverse_masses, shifts, nodes_, parabola);
    factor = parabola.best_factor(reached_ ? most_growth : most_growth_of_a_failure);
    for (size_t d = 0; d < 3; ++d)
    {
      double* const x = positions[d];
      const double* const shift = shifts[d];
      const double times = factor;
#pragma GCC ivdep
      for (int i = 0; i < nodes_; ++i)
      {
        x[i] += times * shift[i];
      }
    }
    for (Run& run : runs_)
    {
      if (run.is_taut)
      {
        for (double* const column : tensions_.from(run.first))
        {
          std::transform(column, column + run.springs.n, column, [factor](double p) { return factor * p; });
        }
        run.is_taut = factor > 0.0;
      }
    }
  });
  return tethers_.relax(inverse_masses, positions, stretch_held(), factor) || factor > 0.0;
}

SpringTensions::Lengths SpringTensions::find_taut(const double* inverse_masses, const Columns<double>& positions)
{
  ++part_calls()[Part::strain_watch];
  Lengths longest = Lengths::slack;
  in_widest_vectors([&](auto) {
    for (Run& run : runs_)
    {
      const SpringRun& springs = run.springs;
      if (last_move(springs.node, springs.n) <= run.found_slack &&
          last_move(springs.node + springs.offset, springs.n) <= run.found_slack)
      {
        continue;
      }
      const double taut = target_length(run);
      const double too_long =
          batches_[springs.batch].rest_length * (1.0 + max_strain_ * (1.0 + StrainLimit::tolerance));
      const SpringRow row = row_of(springs, inverse_masses, positions);
      if (!has_longer(row, taut * taut))
      {
        run.found_slack = now_;
        continue;
      }
      run.is_taut = true;
      longest = std::max(longest, has_longer(row, too_long * too_long) ? Lengths::too_long : Lengths::taut);
    }
  });
  return longest;
}

void SpringTensions::relax_taut(bool backwards, const double* inverse_masses, const Columns<double>& positions)
{
  ++part_calls()[Part::strain_limit];
  ++now_;
  in_widest_vectors([&](auto arithmetic) {
    for (size_t r = 0; r < runs_.size(); ++r)
    {
      Run& run = runs_[backwards ? runs_.size() - 1 - r : r];
      if (run.is_taut)
      {
        relax_run<arithmetic.has_fused_multiply_add>(run, inverse_masses, positions);
      }
    }
  });
}

template <bool fused>
void SpringTensions::relax_run(Run& run, const double* inverse_masses, const Columns<double>& positions)
{
  const SpringRow row = row_of(run.springs, inverse_masses, positions);
  const Columns<double> tensions = tensions_.from(run.first);
  const double longest = target_length(run);
  run.is_taut = false;
  in_turns(run.springs.offset, run.springs.n,
           [&](auto&& is_chosen) { run.is_taut |= relax<fused>(row, tensions, longest, is_chosen); });
  mark_moved(run.springs.node, run.springs.n);
  mark_moved(run.springs.node + run.springs.offset, run.springs.n);
}

void SpringTensions::begin_momentum(const Columns<double>& positions)
{
  momentum_.begin();
  carried_on_at_ = now_;
  for (size_t d = 0; d < 3; ++d)
  {
    std::copy_n(positions[d], nodes_, last_positions_.from(0)[d]);
    std::copy_n(positions[d], nodes_, begins_.from(0)[d]);
  }
  for (Run& run : runs_)
  {
    run.was_taut = run.is_taut;
    for (size_t d = 0; run.is_taut && d < 3; ++d)
    {
      std::copy_n(tensions_.from(run.first)[d], run.springs.n, last_tensions_.from(run.first)[d]);
    }
  }
}

void SpringTensions::carry_on_all(const Columns<double>& positions)
{
  const Columns<double> last = last_positions_.from(0);
  const Columns<double> begins = begins_.from(0);
  const auto for_moved_nodes = [&](auto&& work) {
    for (size_t mark = 0; mark * mark_size < static_cast<size_t>(nodes_); ++mark)
    {
      const int first = static_cast<int>(mark) * mark_size;
      for (size_t d = 0; moved_at_[mark] >= carried_on_at_ && d < 3; ++d)
      {
        work(mark, positions[d] + first, last[d] + first, begins[d] + first, std::min(mark_size, nodes_ - first));
      }
    }
  };
  ++now_;
  in_widest_vectors([&](auto) {
    for_moved_nodes([this](size_t, const double* x, const double* last_x, const double* begin, int n) {
      momentum_.compare(x, last_x, begin, n);
    });
    const double part = momentum_.next_part();
    for_moved_nodes([this, part](size_t mark, double* x, double* last_x, double* begin, int n) {
      carry_on(x, last_x, n, part);
      std::copy_n(x, n, begin);
      moved_at_[mark] = now_;
    });
    for (Run& run : runs_)
    {
      carry_on(run.is_taut, run.was_taut, tensions_.from(run.first), last_tensions_.from(run.first), run.springs.n,
               part);
    }
  });
  carried_on_at_ = now_;
}

void SpringTensions::add_tensions_to(const Columns<double>& shifts) const
{
  tethers_.add_tensions_to(shifts);
  for (const Run& run : runs_)
  {
    const Columns<const double> tensions = tensions_.from(run.first);
    for (int k = 0; run.is_taut && k < run.springs.n; ++k)
    {
      const int node = run.springs.node + k;
      for (size_t d = 0; d < 3; ++d)
      {
        shifts[d][node] += tensions[d][k];
        shifts[d][node + run.springs.offset] -= tensions[d][k];
      }
    }
  }
}

void SpringTensions::mark_moved(int node, int n)
{
  for (int mark = node / mark_size; mark <= (node + n - 1) / mark_size; ++mark)
  {
    moved_at_[static_cast<size_t>(mark)] = now_;
  }
}

long SpringTensions::last_move(int node, int n) const
{
  return std::max(moved_at_[static_cast<size_t>(node / mark_size)],
                  moved_at_[static_cast<size_t>((node + n - 1) / mark_size)]);
}

}  // namespace cloth
