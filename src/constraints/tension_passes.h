#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "cloth_sim/constraints/strain_limit.h"
#include "cloth_sim/model/inverse_root.h"
#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/spring_rows.h"
#include "cloth_sim/model/wide_vectors.h"

#include "../model/aligned_vectors.h"
#include "../model/spring_layout.h"

namespace cloth
{

/// The longest of some springs.
enum class SpringLengths
{
  slack,
  taut,     ///< as long as tensions hold a spring, or longer: it gets one in the next pass
  too_long  ///< longer than the limit and its tolerance allow: there must be a next pass
};

/// A spring from every node to one that is held, as long as the shortest way along springs between them (Kim, Chentanez
/// and Mueller-Fischer, "Long range attachments", 2012). It forbids nothing that they allow, and says in one pass what
/// they pass on from one to the next; but which of both is to pull is open, so that the last digits of a correction from
/// nothing take more passes than without.
template <typename Scalar>
struct Tether
{
  int anchor;                   ///< the held node
  std::vector<Scalar> lengths;  ///< m, at rest; 0: none from this node
};

/// The dual objective along tensions that are multiplied by t is rise t - curvature t^2/2; lane by lane.
template <typename Scalar>
struct DualParabola
{
  alignas(64) Scalar rise[spring_row_size] = {};
  alignas(64) Scalar curvature[spring_row_size] = {};
};

/// Of a spring, over that of its ends' masses: only the choice of the first guess knows of it.
inline constexpr double compliance_of_guess = 1e-4;

/// An integer as wide as the numbers: loops that count in it vectorise.
template <typename Scalar>
using IntegerLike = std::conditional_t<std::is_same_v<Scalar, float>, std::int32_t, std::int64_t>;

/// Gives the chosen springs the tension that is right if all others' are, and moves their ends by the change. Returns
/// whether any of them is taut.
template <bool fused, typename Scalar, typename IsChosen>
bool relax(const SpringRow<Scalar>& row, const Columns<Scalar>& tensions, Scalar longest, IsChosen&& is_chosen)
{
  RowChanges<Scalar> changes;
  const Scalar squared = longest * longest;
  IntegerLike<Scalar> taut = 0;
  const Scalar* const w_i = row.w_i;
  const Scalar* const w_j = row.w_j;
  const Scalar* const x_i = row.i[0];
  const Scalar* const y_i = row.i[1];
  const Scalar* const z_i = row.i[2];
  const Scalar* const x_j = row.j[0];
  const Scalar* const y_j = row.j[1];
  const Scalar* const z_j = row.j[2];
  Scalar* const p_x = tensions[0];
  Scalar* const p_y = tensions[1];
  Scalar* const p_z = tensions[2];
  const int n = row.n;
  const int padded = row.padded();
#pragma GCC ivdep
  for (int k = 0; k < padded; ++k)
  {
    const Scalar w = w_i[k] + w_j[k];
    const Scalar x = x_j[k] - x_i[k] + w * p_x[k];
    const Scalar y = y_j[k] - y_i[k] + w * p_y[k];
    const Scalar z = z_j[k] - z_i[k] + w * p_z[k];
    const Scalar square = x * x + y * y + z * z;
    const bool is_looked_at = is_chosen(k) && k < n;
    const bool is_taut = square > squared && w > Scalar(0);
    const Scalar part = is_taut ? (Scalar(1) - longest * inverse_root<fused>(square)) / w : Scalar(0);
    changes.x[k] = is_looked_at ? part * x - p_x[k] : Scalar(0);
    changes.y[k] = is_looked_at ? part * y - p_y[k] : Scalar(0);
    changes.z[k] = is_looked_at ? part * z - p_z[k] : Scalar(0);
    p_x[k] += changes.x[k];
    p_y[k] += changes.y[k];
    p_z[k] += changes.z[k];
    taut |= is_looked_at && is_taut ? 1 : 0;
  }
  move_ends(row, changes);
  return taut != 0;
}

/// The same for the tethers of n nodes; a taut node moves alone.
template <bool fused, typename Scalar>
bool relax_tethers(const Scalar* inverse_masses, const Columns<Scalar>& nodes, const std::array<Scalar, 3>& anchor,
                   const Scalar* lengths, Scalar stretch, const Columns<Scalar>& tensions, int n)
{
  const Scalar a_x = anchor[0];
  const Scalar a_y = anchor[1];
  const Scalar a_z = anchor[2];
  Scalar* const n_x = nodes[0];
  Scalar* const n_y = nodes[1];
  Scalar* const n_z = nodes[2];
  Scalar* const p_x = tensions[0];
  Scalar* const p_y = tensions[1];
  Scalar* const p_z = tensions[2];
  IntegerLike<Scalar> taut = 0;
#pragma GCC ivdep
  for (int k = 0; k < n; ++k)
  {
    const Scalar w = inverse_masses[k];
    const Scalar longest = stretch * lengths[k];
    const Scalar x = a_x - n_x[k] + w * p_x[k];
    const Scalar y = a_y - n_y[k] + w * p_y[k];
    const Scalar z = a_z - n_z[k] + w * p_z[k];
    const Scalar square = x * x + y * y + z * z;
    const bool is_taut = longest > Scalar(0) && square > longest * longest && w > Scalar(0);
    const Scalar part = is_taut ? (Scalar(1) - longest * inverse_root<fused>(square)) / w : Scalar(0);
    n_x[k] += w * (part * x - p_x[k]);
    n_y[k] += w * (part * y - p_y[k]);
    n_z[k] += w * (part * z - p_z[k]);
    p_x[k] = part * x;
    p_y[k] = part * y;
    p_z[k] = part * z;
    taut |= is_taut ? 1 : 0;
  }
  return taut != 0;
}

/// Adds to the shifts of nodes what their springs' tensions p ask for, and to the parabola the sum of p . l - |p|
/// longest, l being the springs at their positions, and of the compliance times (1/m_i + 1/m_j) |p|^2.
template <bool fused, typename Scalar>
void add_shifts(const SpringRow<Scalar>& positions, const Columns<Scalar>& tensions, Scalar longest,
                const SpringRow<Scalar>& shifts, DualParabola<Scalar>& parabola)
{
  RowChanges<Scalar> pulls;
  const Scalar* const x_i = positions.i[0];
  const Scalar* const y_i = positions.i[1];
  const Scalar* const z_i = positions.i[2];
  const Scalar* const x_j = positions.j[0];
  const Scalar* const y_j = positions.j[1];
  const Scalar* const z_j = positions.j[2];
  const Scalar* const p_x = tensions[0];
  const Scalar* const p_y = tensions[1];
  const Scalar* const p_z = tensions[2];
  const int n = positions.n;
  const int padded = positions.padded();
  const Scalar* const w_i = positions.w_i;
  const Scalar* const w_j = positions.w_j;
#pragma GCC ivdep
  for (int k = 0; k < padded; ++k)
  {
    const Scalar x = k < n ? p_x[k] : Scalar(0);
    const Scalar y = k < n ? p_y[k] : Scalar(0);
    const Scalar z = k < n ? p_z[k] : Scalar(0);
    const Scalar square = x * x + y * y + z * z;
    parabola.rise[k] += x * (x_j[k] - x_i[k]) + y * (y_j[k] - y_i[k]) + z * (z_j[k] - z_i[k]) -
                        longest * square * inverse_root<fused>(square);
    parabola.curvature[k] += Scalar(compliance_of_guess) * (w_i[k] + w_j[k]) * square;
    pulls.x[k] = x;
    pulls.y[k] = y;
    pulls.z[k] = z;
  }
  move_ends(shifts, pulls);
}

/// The same for the tethers of n nodes.
template <bool fused, typename Scalar>
void add_tether_shifts(const Scalar* inverse_masses, const Columns<Scalar>& nodes, const std::array<Scalar, 3>& anchor,
                       const Scalar* lengths, Scalar stretch, const Columns<Scalar>& tensions, int n,
                       const Columns<Scalar>& shifts, DualParabola<Scalar>& parabola)
{
  const Scalar a_x = anchor[0];
  const Scalar a_y = anchor[1];
  const Scalar a_z = anchor[2];
  const Scalar* const n_x = nodes[0];
  const Scalar* const n_y = nodes[1];
  const Scalar* const n_z = nodes[2];
  const Scalar* const p_x = tensions[0];
  const Scalar* const p_y = tensions[1];
  const Scalar* const p_z = tensions[2];
  Scalar* const s_x = shifts[0];
  Scalar* const s_y = shifts[1];
  Scalar* const s_z = shifts[2];
#pragma GCC ivdep
  for (int k = 0; k < n; ++k)
  {
    const Scalar square = p_x[k] * p_x[k] + p_y[k] * p_y[k] + p_z[k] * p_z[k];
    parabola.rise[k] += p_x[k] * (a_x - n_x[k]) + p_y[k] * (a_y - n_y[k]) + p_z[k] * (a_z - n_z[k]) -
                        stretch * lengths[k] * square * inverse_root<fused>(square);
    parabola.curvature[k] += Scalar(compliance_of_guess) * inverse_masses[k] * square;
    s_x[k] += inverse_masses[k] * p_x[k];
    s_y[k] += inverse_masses[k] * p_y[k];
    s_z[k] += inverse_masses[k] * p_z[k];
  }
}

/// Whether any of the springs that are not held at both ends is longer than the length of this square.
template <typename Scalar>
bool has_longer(const SpringRow<Scalar>& row, Scalar longest)
{
  const Scalar* const w_i = row.w_i;
  const Scalar* const w_j = row.w_j;
  const Scalar* const x_i = row.i[0];
  const Scalar* const y_i = row.i[1];
  const Scalar* const z_i = row.i[2];
  const Scalar* const x_j = row.j[0];
  const Scalar* const y_j = row.j[1];
  const Scalar* const z_j = row.j[2];
  const int n = row.n;
  const int padded = row.padded();
  IntegerLike<Scalar> any = 0;
  for (int k = 0; k < padded; ++k)
  {
    const Scalar x = x_j[k] - x_i[k];
    const Scalar y = y_j[k] - y_i[k];
    const Scalar z = z_j[k] - z_i[k];
    any |= x * x + y * y + z * z > longest && w_i[k] + w_j[k] > Scalar(0) && k < n ? 1 : 0;
  }
  return any != 0;
}

/// Whether any of n tethers is taut.
template <typename Scalar>
bool has_taut_tether(const Columns<Scalar>& nodes, const std::array<Scalar, 3>& anchor, const Scalar* lengths,
                     Scalar stretch, int n)
{
  const Scalar a_x = anchor[0];
  const Scalar a_y = anchor[1];
  const Scalar a_z = anchor[2];
  const Scalar* const n_x = nodes[0];
  const Scalar* const n_y = nodes[1];
  const Scalar* const n_z = nodes[2];
  IntegerLike<Scalar> taut = 0;
  for (int k = 0; k < n; ++k)
  {
    const Scalar longest = stretch * lengths[k];
    const Scalar x = a_x - n_x[k];
    const Scalar y = a_y - n_y[k];
    const Scalar z = a_z - n_z[k];
    taut |= longest > Scalar(0) && x * x + y * y + z * z > longest * longest ? 1 : 0;
  }
  return taut != 0;
}

/// The passes of SpringTensions, in double or single precision and for any numbering of the nodes. All arrays of nodes
/// have room for `row_padding` more.
template <typename Scalar>
class TensionPasses
{
public:
  TensionPasses(std::vector<SpringBatch> batches, const std::vector<SpringRun>& runs, int nodes);

  /// To be given anew whenever other nodes are held.
  void use_tethers(std::vector<Tether<Scalar>> tethers);

  StrainLimit::Report shorten(const Scalar* inverse_masses, double max_strain, int passes,
                              const Columns<Scalar>& positions);

  /// Adds the pull of the tensions on every node to the shifts, kg m.
  void add_tensions_to(const Columns<Scalar>& shifts) const;

  void go_on_from(const TensionPasses& before);

private:
  /// The margin (StrainLimit::least_margin) grows while steps need more passes than `few` and dies away while they do
  /// not. Within a step it stays the same.
  static constexpr double margin_growth = 1.5;
  static constexpr double margin_decay = 0.98;
  static constexpr int few = 2;
  /// The most by which tensions grow before a step's passes: not at all where the last step did not reach the limit.
  static constexpr double most_growth = 2.0;
  static constexpr double most_growth_of_a_failure = 1.0;
  /// Nodes are marked as moved by so many.
  static constexpr int mark_size = std::is_same_v<Scalar, float> ? lanes_of<float> : spring_row_size;

  struct Run
  {
    SpringRun springs;
    int first;              ///< of its tensions
    bool is_taut = false;   ///< some spring has a tension, or was found taut
    long found_slack = -1;  ///< when all of its springs were
  };

  struct Tethered
  {
    Tether<Scalar> tether;
    AlignedVectors<Scalar> tensions;
    std::vector<char> is_taut;  ///< for each mark_size nodes
  };

  /// Calls visit(tethered, block, first node) for stretches of mark_size nodes.
  template <typename Visit>
  void for_each_tethered_block(Visit&& visit)
  {
    for (Tethered& tethered : tethers_)
    {
      for (int node = 0; node < nodes_; node += mark_size)
      {
        visit(tethered, static_cast<size_t>(node / mark_size), node);
      }
    }
  }
  Scalar stretch() const
  {
    return Scalar(1.0 + max_strain_ * (1.0 - margin_));
  }
  Scalar target_length(const Run& run) const
  {
    return Scalar(batches_[run.springs.batch].rest_length) * stretch();
  }
  static std::array<Scalar, 3> vector_at(const Columns<Scalar>& columns, int node)
  {
    return { columns[0][node], columns[1][node], columns[2][node] };
  }
  static Columns<Scalar> from(const Columns<Scalar>& columns, int node)
  {
    return { columns[0] + node, columns[1] + node, columns[2] + node };
  }
  SpringRow<Scalar> row_of(const Run& run, const Scalar* inverse_masses, const Columns<Scalar>& columns) const
  {
    return { inverse_masses, columns, run.springs.node, run.springs.offset, run.springs.n };
  }
  int last_of(int node) const
  {
    return std::min(node + mark_size, nodes_) - node;
  }

  /// Pulls with the tensions of the last step times the factor that is best for them. False: they are of no use.
  bool pull_as_before(const Scalar* inverse_masses, const Columns<Scalar>& positions);
  double factor_of(const Scalar* inverse_masses, DualParabola<Scalar>& parabola) const;
  /// Tethers that were slack at a step's begin are left out of it.
  SpringLengths find_taut(bool is_first, const Scalar* inverse_masses, const Columns<Scalar>& positions);
  void relax_taut(bool backwards, const Scalar* inverse_masses, const Columns<Scalar>& positions);
  template <bool fused>
  void relax_run(Run& run, const Scalar* inverse_masses, const Columns<Scalar>& positions);
  static void multiply(const Columns<Scalar>& columns, int n, Scalar factor)
  {
    for (Scalar* const column : columns)
    {
      std::transform(column, column + n, column, [factor](Scalar value) { return factor * value; });
    }
  }
  void scale_tensions(Scalar factor);
  void mark_moved(int node, int n);
  long last_move(int node, int n) const;

  std::vector<SpringBatch> batches_;
  std::vector<Run> runs_;
  std::vector<Tethered> tethers_;
  int nodes_;
  double max_strain_ = 0.0;  ///< of the step
  bool reached_ = true;
  double margin_ = StrainLimit::least_margin;
  AlignedVectors<Scalar> tensions_;  ///< one for each spring, kg m
  AlignedVectors<Scalar> shifts_;    ///< what the tensions of the last step ask for, m
  std::vector<long> moved_at_;       ///< for each mark_size nodes
  long now_ = 0;                     ///< counts passes
};

template <typename Scalar>
TensionPasses<Scalar>::TensionPasses(std::vector<SpringBatch> batches, const std::vector<SpringRun>& runs, int nodes)
  : batches_(std::move(batches)), nodes_(nodes), moved_at_(static_cast<size_t>(nodes / mark_size + 2), 0)
{
  int first = 0;
  for (const SpringRun& run : runs)
  {
    runs_.push_back({ run, first });
    first += (run.n + lanes_of<Scalar> - 1) / lanes_of<Scalar> * lanes_of<Scalar>;
  }
  tensions_.set_zero(first);
  shifts_.set_zero(nodes);
}

template <typename Scalar>
void TensionPasses<Scalar>::use_tethers(std::vector<Tether<Scalar>> tethers)
{
  tethers_.clear();
  for (Tether<Scalar>& tether : tethers)
  {
    tether.lengths.resize(static_cast<size_t>(nodes_ + row_padding), Scalar(0));
    tethers_.push_back({ std::move(tether), {}, std::vector<char>(moved_at_.size(), 0) });
    tethers_.back().tensions.set_zero(nodes_);
  }
}

template <typename Scalar>
void TensionPasses<Scalar>::go_on_from(const TensionPasses& before)
{
  reached_ = before.reached_;
  margin_ = before.margin_;
  auto other = before.runs_.begin();
  for (Run& run : runs_)
  {
    const auto is_same = [&run](const Run& candidate) {
      return candidate.springs.node == run.springs.node && candidate.springs.offset == run.springs.offset &&
             candidate.springs.n == run.springs.n;
    };
    const auto found = std::find_if(other, before.runs_.end(), is_same);
    if (found == before.runs_.end())
    {
      continue;
    }
    other = std::next(found);
    run.is_taut = found->is_taut;
    const Columns<Scalar> tensions = tensions_.from(run.first);
    const Columns<const Scalar> theirs = before.tensions_.from(found->first);
    for (size_t d = 0; d < 3; ++d)
    {
      std::copy_n(theirs[d], run.springs.n, tensions[d]);
    }
  }
}

template <typename Scalar>
StrainLimit::Report TensionPasses<Scalar>::shorten(const Scalar* inverse_masses, double max_strain, int passes,
                                                   const Columns<Scalar>& positions)
{
  max_strain_ = max_strain;
  ++now_;
  std::fill(moved_at_.begin(), moved_at_.end(), now_);
  StrainLimit::Report report;
  report.moved = pull_as_before(inverse_masses, positions);
  SpringLengths longest = find_taut(true, inverse_masses, positions);
  for (bool goes_on = report.moved || longest != SpringLengths::slack; goes_on;
       goes_on = longest == SpringLengths::too_long)
  {
    if (report.sweeps >= passes)
    {
      report.reached = false;
      break;
    }
    relax_taut(report.sweeps % 2 == 1, inverse_masses, positions);
    report.moved = true;
    ++report.sweeps;
    longest = find_taut(false, inverse_masses, positions);
  }
  reached_ = report.reached;
  margin_ = std::clamp(margin_ * (report.sweeps > few ? margin_growth : margin_decay), StrainLimit::least_margin,
                       StrainLimit::most_margin);
  return report;
}

// The dual objective, sum of p . l - |p| l_max less half the sum of m |shift|^2, is 0 without tensions; along the
// tensions of the last step it is highest where they are multiplied by the factor below. Tensions that shift nothing,
// because they hold each other or pull on pins alone, would be multiplied for ever were springs not thought to give way
// a little at this point.
template <typename Scalar>
bool TensionPasses<Scalar>::pull_as_before(const Scalar* inverse_masses, const Columns<Scalar>& positions)
{
  const Columns<Scalar> shifts = shifts_.from(0);
  DualParabola<Scalar> parabola;
  double factor = 0.0;
  in_widest_vectors([&](auto arithmetic) {
    constexpr bool fused = arithmetic.has_fused_multiply_add;
    for (Scalar* const column : shifts)
    {
      std::fill_n(column, nodes_ + row_padding, Scalar(0));
    }
    for_each_tethered_block([&](Tethered& tethered, size_t block, int node) {
      if (tethered.is_taut[block])
      {
        add_tether_shifts<fused>(inverse_masses + node, from(positions, node),
                                 vector_at(positions, tethered.tether.anchor), tethered.tether.lengths.data() + node,
                                 stretch(), tethered.tensions.from(node), last_of(node), from(shifts, node), parabola);
      }
    });
    for (const Run& run : runs_)
    {
      if (run.is_taut)
      {
        add_shifts<fused>(row_of(run, inverse_masses, positions), tensions_.from(run.first), target_length(run),
                          row_of(run, inverse_masses, shifts), parabola);
      }
    }
    factor = factor_of(inverse_masses, parabola);
    for (size_t d = 0; d < 3; ++d)
    {
      Scalar* const x = positions[d];
      const Scalar* const shift = shifts[d];
      const auto times = Scalar(factor);
#pragma GCC ivdep
      for (int i = 0; i < nodes_; ++i)
      {
        x[i] += times * shift[i];
      }
    }
    scale_tensions(Scalar(factor));
  });
  return factor > 0.0;
}

/// 0 where tensions are of no use.
template <typename Scalar>
double TensionPasses<Scalar>::factor_of(const Scalar* inverse_masses, DualParabola<Scalar>& parabola) const
{
  const Columns<const Scalar> shifts = shifts_.from(0);
  const Scalar* const x = shifts[0];
  const Scalar* const y = shifts[1];
  const Scalar* const z = shifts[2];
  Scalar* const curvature = parabola.curvature;
  for (int begin = 0; begin < nodes_; begin += lanes_of<Scalar>)
  {
#pragma GCC ivdep
    for (int k = 0; k < lanes_of<Scalar>; ++k)
    {
      const int i = begin + k;
      const Scalar square = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
      curvature[k] += square > Scalar(0) ? square / inverse_masses[i] : Scalar(0);
    }
  }
  double rises = 0.0;
  double curvatures = 0.0;
  for (int k = 0; k < spring_row_size; ++k)
  {
    rises += double(parabola.rise[k]);
    curvatures += double(parabola.curvature[k]);
  }
  if (!(rises > 0.0 && curvatures > 0.0))
  {
    return 0.0;
  }
  return std::min(rises / curvatures, reached_ ? most_growth : most_growth_of_a_failure);
}

template <typename Scalar>
void TensionPasses<Scalar>::scale_tensions(Scalar factor)
{
  for_each_tethered_block([&](Tethered& tethered, size_t block, int node) {
    if (tethered.is_taut[block])
    {
      multiply(tethered.tensions.from(node), last_of(node), factor);
      tethered.is_taut[block] = factor > Scalar(0) ? 1 : 0;
    }
  });
  for (Run& run : runs_)
  {
    if (run.is_taut)
    {
      multiply(tensions_.from(run.first), run.springs.n, factor);
      run.is_taut = factor > Scalar(0);
    }
  }
}

template <typename Scalar>
SpringLengths TensionPasses<Scalar>::find_taut(bool is_first, const Scalar* inverse_masses,
                                               const Columns<Scalar>& positions)
{
  ++part_calls()[Part::strain_watch];
  SpringLengths longest = SpringLengths::slack;
  in_widest_vectors([&](auto) {
    for_each_tethered_block([&](Tethered& tethered, size_t block, int node) {
      if (is_first && !tethered.is_taut[block] &&
          has_taut_tether(from(positions, node), vector_at(positions, tethered.tether.anchor),
                          tethered.tether.lengths.data() + node, stretch(), last_of(node)))
      {
        tethered.is_taut[block] = 1;
      }
    });
    for (Run& run : runs_)
    {
      const SpringRun& springs = run.springs;
      if (last_move(springs.node, springs.n) <= run.found_slack &&
          last_move(springs.node + springs.offset, springs.n) <= run.found_slack)
      {
        continue;
      }
      const Scalar taut = target_length(run);
      const auto too_long =
          Scalar(batches_[springs.batch].rest_length * (1.0 + max_strain_ * (1.0 + StrainLimit::tolerance)));
      const SpringRow<Scalar> row = row_of(run, inverse_masses, positions);
      if (!has_longer(row, taut * taut))
      {
        run.found_slack = now_;
        continue;
      }
      run.is_taut = true;
      longest = std::max(longest, has_longer(row, too_long * too_long) ? SpringLengths::too_long : SpringLengths::taut);
    }
  });
  return longest;
}

template <typename Scalar>
void TensionPasses<Scalar>::relax_taut(bool backwards, const Scalar* inverse_masses, const Columns<Scalar>& positions)
{
  ++part_calls()[Part::strain_limit];
  ++now_;
  in_widest_vectors([&](auto arithmetic) {
    constexpr bool fused = arithmetic.has_fused_multiply_add;
    for_each_tethered_block([&](Tethered& tethered, size_t block, int node) {
      if (tethered.is_taut[block])
      {
        const bool is_taut = relax_tethers<fused>(
            inverse_masses + node, from(positions, node), vector_at(positions, tethered.tether.anchor),
            tethered.tether.lengths.data() + node, stretch(), tethered.tensions.from(node), last_of(node));
        tethered.is_taut[block] = is_taut ? 1 : 0;
        mark_moved(node, last_of(node));
      }
    });
    for (size_t r = 0; r < runs_.size(); ++r)
    {
      Run& run = runs_[backwards ? runs_.size() - 1 - r : r];
      if (run.is_taut)
      {
        relax_run<fused>(run, inverse_masses, positions);
      }
    }
  });
}

template <typename Scalar>
template <bool fused>
void TensionPasses<Scalar>::relax_run(Run& run, const Scalar* inverse_masses, const Columns<Scalar>& positions)
{
  const SpringRow<Scalar> row = row_of(run, inverse_masses, positions);
  const Columns<Scalar> tensions = tensions_.from(run.first);
  const Scalar longest = target_length(run);
  run.is_taut = false;
  in_turns(run.springs.offset, run.springs.n,
           [&](auto&& is_chosen) { run.is_taut |= relax<fused>(row, tensions, longest, is_chosen); });
  mark_moved(run.springs.node, run.springs.n);
  mark_moved(run.springs.node + run.springs.offset, run.springs.n);
}

template <typename Scalar>
void TensionPasses<Scalar>::add_tensions_to(const Columns<Scalar>& shifts) const
{
  for (const Tethered& tethered : tethers_)
  {
    for (size_t d = 0; d < 3; ++d)
    {
      const Scalar* const tensions = tethered.tensions.from(0)[d];
      for (int i = 0; i < nodes_; ++i)
      {
        shifts[d][i] += tensions[i];
        shifts[d][tethered.tether.anchor] -= tensions[i];
      }
    }
  }
  for (const Run& run : runs_)
  {
    const Columns<const Scalar> tensions = tensions_.from(run.first);
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

template <typename Scalar>
void TensionPasses<Scalar>::mark_moved(int node, int n)
{
  for (int mark = node / mark_size; mark <= (node + n - 1) / mark_size; ++mark)
  {
    moved_at_[static_cast<size_t>(mark)] = now_;
  }
}

template <typename Scalar>
long TensionPasses<Scalar>::last_move(int node, int n) const
{
  return std::max(moved_at_[static_cast<size_t>(node / mark_size)],
                  moved_at_[static_cast<size_t>((node + n - 1) / mark_size)]);
}

}  // namespace cloth
