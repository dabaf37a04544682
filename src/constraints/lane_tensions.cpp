#include "lane_tensions.h"

#include <algorithm>

#include "cloth_sim/model/inverse_root.h"
#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/wide_vectors.h"

#include "shortening.h"

namespace cloth
{
namespace
{

/// Multiplies the tensions by `factor`, gives each spring the one that is right if all others' are, and moves its ends
/// by the change. Returns whether any is taut.
template <bool fused>
bool relax_run(const LaneEnds& ends, const Columns<float>& tensions, const float* reduced_masses, float longest,
               float factor)
{
  float* const p_x = tensions[0];
  float* const p_y = tensions[1];
  float* const p_z = tensions[2];
  const float squared = longest * longest;
  int taut = 0;
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const float way_x_i = ends.way_x_i[k];
    const float way_y_i = ends.way_y_i[k];
    const float way_z_i = ends.way_z_i[k];
    const float way_x_j = ends.way_x_j[k];
    const float way_y_j = ends.way_y_j[k];
    const float way_z_j = ends.way_z_j[k];
    const float old_x = factor * p_x[k];
    const float old_y = factor * p_y[k];
    const float old_z = factor * p_z[k];
    const float w = ends.w_i[k] + ends.w_j[k];
    const float x = ends.x_j[k] - ends.x_i[k] + (way_x_j - way_x_i) + w * old_x;
    const float y = ends.y_j[k] - ends.y_i[k] + (way_y_j - way_y_i) + w * old_y;
    const float z = ends.z_j[k] - ends.z_i[k] + (way_z_j - way_z_i) + w * old_z;
    const float square = x * x + y * y + z * z;
    const bool is_taut = square > squared && reduced_masses[k] > 0.0F;
    const float part = is_taut ? (1.0F - longest * inverse_root<fused>(square)) * reduced_masses[k] : 0.0F;
    const float change_x = part * x - old_x;
    const float change_y = part * y - old_y;
    const float change_z = part * z - old_z;
    p_x[k] = part * x;
    p_y[k] = part * y;
    p_z[k] = part * z;
    ends.way_x_i[k] = way_x_i + ends.w_i[k] * change_x;
    ends.way_y_i[k] = way_y_i + ends.w_i[k] * change_y;
    ends.way_z_i[k] = way_z_i + ends.w_i[k] * change_z;
    ends.way_x_j[k] = way_x_j - ends.w_j[k] * change_x;
    ends.way_y_j[k] = way_y_j - ends.w_j[k] * change_y;
    ends.way_z_j[k] = way_z_j - ends.w_j[k] * change_z;
    taut |= is_taut ? 1 : 0;
  }
  return taut != 0;
}

bool run_has_longer(const LaneEnds& ends, const float* reduced_masses, float longest)
{
  const float squared = longest * longest;
  int any = 0;
  for (int k = 0; k < lanes; ++k)
  {
    const float x = ends.x_j[k] - ends.x_i[k] + (ends.way_x_j[k] - ends.way_x_i[k]);
    const float y = ends.y_j[k] - ends.y_i[k] + (ends.way_y_j[k] - ends.way_y_i[k]);
    const float z = ends.z_j[k] - ends.z_i[k] + (ends.way_z_j[k] - ends.way_z_i[k]);
    any |= x * x + y * y + z * z > squared && reduced_masses[k] > 0.0F ? 1 : 0;
  }
  return any != 0;
}

/// `shifted` has the shifts for ways.
template <bool fused>
void add_run_shifts(const LaneEnds& ends, const Columns<float>& tensions, float longest, const LaneEnds& shifted,
                    DualParabola<float>& parabola)
{
  const float* const p_x = tensions[0];
  const float* const p_y = tensions[1];
  const float* const p_z = tensions[2];
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const float x = ends.x_j[k] - ends.x_i[k] + (ends.way_x_j[k] - ends.way_x_i[k]);
    const float y = ends.y_j[k] - ends.y_i[k] + (ends.way_y_j[k] - ends.way_y_i[k]);
    const float z = ends.z_j[k] - ends.z_i[k] + (ends.way_z_j[k] - ends.way_z_i[k]);
    const float square = p_x[k] * p_x[k] + p_y[k] * p_y[k] + p_z[k] * p_z[k];
    parabola.rise[k] += p_x[k] * x + p_y[k] * y + p_z[k] * z - longest * square * inverse_root<fused>(square);
    parabola.curvature[k] += float(DualParabola<float>::compliance) * (ends.w_i[k] + ends.w_j[k]) * square;
    const float x_i = shifted.way_x_i[k] + ends.w_i[k] * p_x[k];
    const float y_i = shifted.way_y_i[k] + ends.w_i[k] * p_y[k];
    const float z_i = shifted.way_z_i[k] + ends.w_i[k] * p_z[k];
    const float x_j = shifted.way_x_j[k] - ends.w_j[k] * p_x[k];
    const float y_j = shifted.way_y_j[k] - ends.w_j[k] * p_y[k];
    const float z_j = shifted.way_z_j[k] - ends.w_j[k] * p_z[k];
    shifted.way_x_i[k] = x_i;
    shifted.way_y_i[k] = y_i;
    shifted.way_z_i[k] = z_i;
    shifted.way_x_j[k] = x_j;
    shifted.way_y_j[k] = y_j;
    shifted.way_z_j[k] = z_j;
  }
}

}  // namespace

LaneTensions::LaneTensions(const ClothModel& model, const LaneLayout& layout) : tethers_(model, layout)
{
  const std::vector<SpringBatch> batches = limited_batches(model);
  for (const SpringBatch& batch : batches)
  {
    rest_lengths_.push_back(static_cast<float>(batch.rest_length));
  }
  int first = 0;
  for (const SpringRun& run : layout.runs(batches, 1))
  {
    runs_.push_back({ run, first });
    first += lanes;
  }
  tensions_.set_zero(first);
  shifts_.set_zero(layout.nodes());
}

void LaneTensions::prepare(const float* inverse_masses, const std::vector<int>& held)
{
  tethers_.hold(held);
  reduced_masses_.clear();
  for (const Run& run : runs_)
  {
    LaneTable::Row masses{};
    for (int k = 0; k < run.springs.n; ++k)
    {
      const float w = inverse_masses[run.springs.node + k] + inverse_masses[run.springs.node + run.springs.offset + k];
      masses[static_cast<size_t>(k)] = w > 0.0F ? 1.0F / w : 0.0F;
    }
    reduced_masses_.add(masses);
  }
}

int LaneTensions::follow(const LaneNodes& nodes, double max_strain, int passes)
{
  const float target = stretch_held(max_strain);
  const auto most = static_cast<float>(1.0 + max_strain * (1.0 + excess_between));
  const bool is_watched = falls_behind_ || ++follows_ % follows_a_watch == 0;
  const int allowed = std::min(passes, is_watched ? most_passes_between : 1);
  float factor = pull_as_before(nodes, target);
  int done = 0;
  while (done < allowed && (done == 0 || has_longer(nodes, most, Springs::taut)) && relax(nodes, target, factor))
  {
    factor = 1.0F;
    ++done;
  }
  falls_behind_ = falls_behind_ || done > 1;
  return done;
}

int LaneTensions::finish(const LaneNodes& nodes, double max_strain, int passes)
{
  const float target = stretch_held(max_strain);
  const auto most = static_cast<float>(1.0 + max_strain * (1.0 + excess_at_end));
  int done = 0;
  while (done < passes && has_longer(nodes, most, Springs::all) && relax(nodes, target, 1.0F))
  {
    ++done;
  }
  falls_behind_ = done > 1;
  margin_ = falls_behind_ ? std::min(margin_growth * std::max(margin_, first_margin), most_margin) :
                            std::max(margin_decay * margin_, StrainLimit::least_margin);
  return done;
}

float LaneTensions::stretch_held(double max_strain) const
{
  return static_cast<float>(1.0 + max_strain * (1.0 - margin_));
}

float LaneTensions::pull_as_before(const LaneNodes& nodes, float stretch)
{
  const Columns<float> shifts = shifts_.from(0);
  DualParabola<float> parabola;
  double factor = 0.0;
  in_widest_vectors([&](auto arithmetic) {
    for (float* const column : shifts)
    {
      std::fill_n(column, nodes.nodes, 0.0F);
    }
    const LaneNodes shifted{ nodes.inverse_masses, nodes.positions, shifts, nodes.nodes };
    tethers_.add_shifts(nodes, stretch, shifts, parabola);
    for (const Run& run : runs_)
    {
      if (run.is_taut)
      {
        add_run_shifts<arithmetic.has_fused_multiply_add>(LaneEnds(nodes, run.springs), tensions_.from(run.first),
                                                          stretch * rest_lengths_[run.springs.batch],
                                                          LaneEnds(shifted, run.springs), parabola);
      }
    }
    parabola.add_masses(nodes.inverse_masses, { shifts[0], shifts[1], shifts[2] }, nodes.nodes);
    factor = parabola.best_factor(most_growth);
    const auto times = static_cast<float>(factor);
    for (size_t d = 0; d < 3; ++d)
    {
      float* const way = nodes.ways[d];
      const float* const shift = shifts[d];
#pragma GCC ivdep
      for (int i = 0; i < nodes.nodes; ++i)
      {
        way[i] += times * shift[i];
      }
    }
  });
  return static_cast<float>(factor);
}

bool LaneTensions::relax(const LaneNodes& nodes, float stretch, float factor)
{
  ++part_calls()[Part::strain_watch];
  tethers_.relax(nodes, stretch, factor);
  backwards_ = !backwards_;
  bool is_taut = false;
  in_widest_vectors([&](auto arithmetic) {
    const size_t n = runs_.size();
    for (size_t r = 0; r < n; ++r)
    {
      const size_t number = backwards_ ? n - 1 - r : r;
      Run& run = runs_[number];
      const LaneEnds ends(nodes, run.springs);
      const float* const reduced_masses = reduced_masses_[number];
      const float longest = stretch * rest_lengths_[run.springs.batch];
      if (run.is_taut || (backwards_ && run_has_longer(ends, reduced_masses, longest)))
      {
        run.is_taut = relax_run<arithmetic.has_fused_multiply_add>(ends, tensions_.from(run.first), reduced_masses,
                                                                   longest, factor);
        is_taut = true;
      }
    }
  });
  part_calls()[Part::strain_limit] += is_taut ? 1 : 0;
  return is_taut;
}

bool LaneTensions::has_longer(const LaneNodes& nodes, float stretch, Springs springs) const
{
  ++part_calls()[Part::strain_watch];
  bool found = false;
  in_widest_vectors([&](auto) {
    for (size_t r = 0; r < runs_.size() && !found; ++r)
    {
      const Run& run = runs_[r];
      found = (springs == Springs::all || run.is_taut) &&
              run_has_longer(LaneEnds(nodes, run.springs), reduced_masses_[r],
                             stretch * rest_lengths_[run.springs.batch]);
    }
  });
  return found;
}

void LaneTensions::add_tensions_to(const Columns<float>& pulls) const
{
  tethers_.add_tensions_to(pulls);
  for (const Run& run : runs_)
  {
    const Columns<const float> tensions = tensions_.from(run.first);
    for (int k = 0; run.is_taut && k < run.springs.n; ++k)
    {
      const int node = run.springs.node + k;
      for (size_t d = 0; d < 3; ++d)
      {
        pulls[d][node] += tensions[d][k];
        pulls[d][node + run.springs.offset] -= tensions[d][k];
      }
    }
  }
}

}  // namespace cloth
