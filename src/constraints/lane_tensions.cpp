#include "lane_tensions.h"

#include <algorithm>
#include <array>

#include "cloth_sim/model/inverse_root.h"
#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/wide_vectors.h"

#include "shortening.h"

namespace cloth
{
namespace
{

/// Gives each spring the tension that is right if all others' are, and moves its ends, i and j in the blocks of nodes,
/// by the change. In a first pass tensions are multiplied by `factor` before. Returns whether any is taut, where that
/// is asked for: a first pass.
template <bool fused, bool is_first>
bool relax_run(float* i, float* j, float* tensions, const float* reduced_masses, float longest, float factor)
{
  using namespace lane_node;
  int taut = 0;
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const float way_x_i = i[way_x + k];
    const float way_y_i = i[way_y + k];
    const float way_z_i = i[way_z + k];
    const float way_x_j = j[way_x + k];
    const float way_y_j = j[way_y + k];
    const float way_z_j = j[way_z + k];
    const float p_x = is_first ? factor * tensions[lane_vector::x + k] : tensions[lane_vector::x + k];
    const float p_y = is_first ? factor * tensions[lane_vector::y + k] : tensions[lane_vector::y + k];
    const float p_z = is_first ? factor * tensions[lane_vector::z + k] : tensions[lane_vector::z + k];
    const float w_i = i[inverse_mass + k];
    const float w_j = j[inverse_mass + k];
    const float w = w_i + w_j;
    const float d_x = j[x + k] - i[x + k] + (way_x_j - way_x_i) + w * p_x;
    const float d_y = j[y + k] - i[y + k] + (way_y_j - way_y_i) + w * p_y;
    const float d_z = j[z + k] - i[z + k] + (way_z_j - way_z_i) + w * p_z;
    const float square = d_x * d_x + d_y * d_y + d_z * d_z;
    const float part = std::max(0.0F, 1.0F - longest * inverse_root<fused>(square)) * reduced_masses[k];
    const float change_x = part * d_x - p_x;
    const float change_y = part * d_y - p_y;
    const float change_z = part * d_z - p_z;
    tensions[lane_vector::x + k] = part * d_x;
    tensions[lane_vector::y + k] = part * d_y;
    tensions[lane_vector::z + k] = part * d_z;
    i[way_x + k] = way_x_i + w_i * change_x;
    i[way_y + k] = way_y_i + w_i * change_y;
    i[way_z + k] = way_z_i + w_i * change_z;
    j[way_x + k] = way_x_j - w_j * change_x;
    j[way_y + k] = way_y_j - w_j * change_y;
    j[way_z + k] = way_z_j - w_j * change_z;
    if constexpr (is_first)
    {
      taut |= part > 0.0F ? 1 : 0;
    }
  }
  return is_first ? taut != 0 : true;
}

bool run_has_longer(const float* i, const float* j, const float* reduced_masses, float longest)
{
  using namespace lane_node;
  const float squared = longest * longest;
  int longer = 0;
  for (int k = 0; k < lanes; ++k)
  {
    const float l_x = j[x + k] - i[x + k] + (j[way_x + k] - i[way_x + k]);
    const float l_y = j[y + k] - i[y + k] + (j[way_y + k] - i[way_y + k]);
    const float l_z = j[z + k] - i[z + k] + (j[way_z + k] - i[way_z + k]);
    longer |= l_x * l_x + l_y * l_y + l_z * l_z > squared && reduced_masses[k] > 0.0F ? 1 : 0;
  }
  return longer != 0;
}

template <bool fused>
void add_run_shifts(const float* i, const float* j, const float* tensions, float longest, float* shift_i,
                    float* shift_j, DualParabola<float>& parabola)
{
  using namespace lane_node;
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const float l_x = j[x + k] - i[x + k] + (j[way_x + k] - i[way_x + k]);
    const float l_y = j[y + k] - i[y + k] + (j[way_y + k] - i[way_y + k]);
    const float l_z = j[z + k] - i[z + k] + (j[way_z + k] - i[way_z + k]);
    const float p_x = tensions[lane_vector::x + k];
    const float p_y = tensions[lane_vector::y + k];
    const float p_z = tensions[lane_vector::z + k];
    const float w_i = i[inverse_mass + k];
    const float w_j = j[inverse_mass + k];
    const float square = p_x * p_x + p_y * p_y + p_z * p_z;
    parabola.rise[k] += p_x * l_x + p_y * l_y + p_z * l_z - longest * square * inverse_root<fused>(square);
    parabola.curvature[k] += float(DualParabola<float>::compliance) * (w_i + w_j) * square;
    add_to_ends(shift_i, shift_j, k, p_x, p_y, p_z, w_i, w_j);
  }
}

void add_masses(const float* nodes, const float* shifts, DualParabola<float>& parabola)
{
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const float x = shifts[lane_vector::x + k];
    const float y = shifts[lane_vector::y + k];
    const float z = shifts[lane_vector::z + k];
    const float square = x * x + y * y + z * z;
    parabola.curvature[k] += square > 0.0F ? square / nodes[lane_node::inverse_mass + k] : 0.0F;
  }
}

template <typename Number>
Number* ways_of(Number* nodes, int vector)
{
  static_assert(lane_vector::y - lane_vector::x == lane_node::way_y - lane_node::way_x);
  return nodes + vector * LaneNodes::size + lane_node::way_x;
}

/// Shifts nodes, and leaves shifts of 0 behind.
void shift(float* nodes, float* shifts, float factor)
{
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    nodes[lane_node::way_x + k] += factor * shifts[lane_vector::x + k];
    nodes[lane_node::way_y + k] += factor * shifts[lane_vector::y + k];
    nodes[lane_node::way_z + k] += factor * shifts[lane_vector::z + k];
    shifts[lane_vector::x + k] = 0.0F;
    shifts[lane_vector::y + k] = 0.0F;
    shifts[lane_vector::z + k] = 0.0F;
  }
}

}  // namespace

LaneTensions::LaneTensions(const ClothModel& model, const LaneLayout& layout)
  : tethers_(model, layout), vectors_(layout.nodes() / lanes)
{
  const std::vector<SpringBatch> batches = limited_batches(model);
  for (const SpringBatch& batch : batches)
  {
    rest_lengths_.push_back(static_cast<float>(batch.rest_length));
  }
  for (const SpringRun& run : layout.runs(batches, rows_a_band))
  {
    runs_.push_back({ LaneRun(run) });
  }
  tensions_.set_zero(static_cast<int>(runs_.size()) * lanes);
  last_tensions_ = tensions_;
  shifts_.set_zero(layout.nodes());
  last_ways_ = shifts_;
  begins_ = shifts_;
}

void LaneTensions::prepare(const LaneNodes& nodes, const std::vector<int>& held)
{
  tethers_.prepare(nodes, held);
  reduced_masses_.clear();
  for (const Run& run : runs_)
  {
    reduced_masses_.add(numbers_of_springs(nodes, run.springs, [](float w) { return 1.0F / w; }));
  }
}

int LaneTensions::follow(LaneNodes& nodes, double max_strain, int passes, double h)
{
  if (follows_ == 0)
  {
    choose_first_margin(nodes, max_strain);
  }
  margin_ += std::clamp(wanted_margin_ - margin_, -margin_speed * h, margin_speed * h);
  const float target = stretch_held(max_strain);
  const double excess = excess_between(max_strain, h);
  const auto most = static_cast<float>(1.0 + max_strain * (1.0 + excess));
  const bool is_watched = ++follows_ % follows_a_watch == 0 || falls_behind_ || excess < most_excess_between;
  const int allowed = std::min(passes, is_watched ? most_passes_between : there_and_back);
  float factor = pull_as_before(nodes, target);
  int done = 0;
  while (done < allowed && (done < there_and_back || has_longer(nodes, most, Springs::taut)))
  {
    give_momentum(nodes, done);
    if (!relax(nodes, target, factor, done == 0 && is_watched ? Springs::all : Springs::taut))
    {
      break;
    }
    factor = 1.0F;
    ++done;
  }
  falls_behind_ = falls_behind_ || done > there_and_back;
  return done;
}

int LaneTensions::finish(LaneNodes& nodes, double max_strain, int passes)
{
  const float target = stretch_held(max_strain);
  const auto most = static_cast<float>(1.0 + max_strain * (1.0 + excess_at_end));
  int done = 0;
  while (done < passes && has_longer(nodes, most, Springs::all))
  {
    give_momentum(nodes, done);
    relax(nodes, target, 1.0F, Springs::all);
    ++done;
  }
  falls_behind_ = done > 1;
  wanted_margin_ = falls_behind_ ? std::min(margin_growth * std::max(wanted_margin_, first_margin), most_margin) :
                                   std::max(margin_decay * wanted_margin_, least_margin);
  return done;
}

double LaneTensions::excess_between(double max_strain, double h) const
{
  const double longest = *std::max_element(rest_lengths_.begin(), rest_lengths_.end());
  return std::min(most_excess_between, most_speed_of_excess * h / (max_strain * longest));
}

float LaneTensions::stretch_held(double max_strain) const
{
  return static_cast<float>(1.0 + max_strain * (1.0 - margin_));
}

void LaneTensions::choose_first_margin(const LaneNodes& nodes, double max_strain)
{
  while (margin_ > least_margin && has_longer(nodes, stretch_held(max_strain), Springs::all))
  {
    margin_ = std::max(margin_ / margin_growth, least_margin);
  }
  wanted_margin_ = margin_;
}

float LaneTensions::pull_as_before(LaneNodes& nodes, float stretch)
{
  DualParabola<float> parabola;
  float factor = 0.0F;
  tethers_.add_shifts(nodes, stretch, shifts_, parabola);
  in_widest_vectors([&](auto arithmetic) {
    float* const at = nodes.data();
    float* const shifts = shifts_.data();
    for (const size_t r : taut_)
    {
      const LaneRun& springs = runs_[r].springs;
      add_run_shifts<arithmetic.has_fused_multiply_add>(kept(at + springs.place_i), kept(at + springs.place_j),
                                                        kept(tensions_of(r)), stretch * rest_lengths_[springs.batch],
                                                        kept(shifts + LaneVectors::place_of(springs.i)),
                                                        kept(shifts + LaneVectors::place_of(springs.j)), parabola);
    }
    for (int v = 0; v < vectors_; ++v)
    {
      add_masses(at + v * LaneNodes::size, shifts + v * LaneVectors::size, parabola);
    }
    factor = static_cast<float>(parabola.best_factor(most_growth));
    for (int v = 0; v < vectors_; ++v)
    {
      shift(at + v * LaneNodes::size, shifts + v * LaneVectors::size, factor);
    }
  });
  return factor;
}

bool LaneTensions::relax(LaneNodes& nodes, float stretch, float factor, Springs springs)
{
  ++part_calls()[Part::strain_watch];
  tethers_.relax(nodes, stretch, factor);
  if (springs == Springs::all)
  {
    find_taut(nodes, stretch);
  }
  backwards_ = !backwards_;
  if (springs == Springs::all || factor != 1.0F)
  {
    relax_taut<true>(nodes, stretch, factor);
  }
  else
  {
    relax_taut<false>(nodes, stretch, factor);
  }
  const bool is_any = !taut_.empty();
  part_calls()[Part::strain_limit] += is_any ? 1 : 0;
  taut_.erase(std::remove_if(taut_.begin(), taut_.end(), [this](size_t r) { return !runs_[r].is_taut; }), taut_.end());
  return is_any;
}

template <bool is_first>
void LaneTensions::relax_taut(LaneNodes& nodes, float stretch, float factor)
{
  in_widest_vectors([&](auto arithmetic) {
    float* const at = nodes.data();
    for (size_t done = 0; done < taut_.size(); ++done)
    {
      const size_t r = taut_[backwards_ ? taut_.size() - 1 - done : done];
      Run& run = runs_[r];
      run.is_taut = relax_run<arithmetic.has_fused_multiply_add, is_first>(
          kept(at + run.springs.place_i), kept(at + run.springs.place_j), kept(tensions_of(r)),
          kept(reduced_masses_[r]), stretch * rest_lengths_[run.springs.batch], factor);
    }
  });
}

void LaneTensions::find_taut(const LaneNodes& nodes, float stretch)
{
  taut_.resize(runs_.size());
  size_t found = 0;
  in_widest_vectors([&](auto) {
    const float* const at = nodes.data();
    for (size_t r = 0; r < runs_.size(); ++r)
    {
      const LaneRun& springs = runs_[r].springs;
      const bool is_longer = run_has_longer(kept(at + springs.place_i), kept(at + springs.place_j),
                                            kept(reduced_masses_[r]), stretch * rest_lengths_[springs.batch]);
      taut_[found] = static_cast<std::uint32_t>(r);
      found += runs_[r].is_taut | is_longer ? 1 : 0;
    }
  });
  taut_.resize(found);
}

void LaneTensions::list_taut()
{
  taut_.resize(runs_.size());
  size_t found = 0;
  for (size_t r = 0; r < runs_.size(); ++r)
  {
    taut_[found] = static_cast<std::uint32_t>(r);
    found += runs_[r].is_taut ? 1 : 0;
  }
  taut_.resize(found);
}

void LaneTensions::give_momentum(LaneNodes& nodes, int passes)
{
  if (momentum_.is_to_begin(passes))
  {
    begin_momentum(nodes);
  }
  else if (momentum_.is_to_carry_on(passes))
  {
    carry_on_all(nodes);
  }
}

void LaneTensions::begin_momentum(const LaneNodes& nodes)
{
  momentum_.begin();
  for (int v = 0; v < vectors_; ++v)
  {
    std::copy_n(ways_of(nodes.data(), v), LaneVectors::size, last_ways_.data() + v * LaneVectors::size);
  }
  begins_ = last_ways_;
  for (size_t r = 0; r < runs_.size(); ++r)
  {
    runs_[r].was_taut = runs_[r].is_taut;
    std::copy_n(tensions_of(r), runs_[r].is_taut ? LaneVectors::size : 0, last_tensions_of(r));
  }
  tethers_.begin_momentum();
}

void LaneTensions::carry_on_all(LaneNodes& nodes)
{
  float part = 0.0F;
  in_widest_vectors([&](auto) {
    for (int v = 0; v < vectors_; ++v)
    {
      const int first = v * LaneVectors::size;
      momentum_.compare(ways_of(nodes.data(), v), last_ways_.data() + first, begins_.data() + first, LaneVectors::size);
    }
    part = momentum_.next_part();
    for (int v = 0; v < vectors_; ++v)
    {
      const int first = v * LaneVectors::size;
      float* const ways = ways_of(nodes.data(), v);
      carry_on(kept(ways), kept(last_ways_.data() + first), LaneVectors::size, part);
      std::copy_n(ways, LaneVectors::size, begins_.data() + first);
    }
    for (size_t r = 0; r < runs_.size(); ++r)
    {
      carry_on(runs_[r].is_taut, runs_[r].was_taut, std::array{ tensions_of(r) }, std::array{ last_tensions_of(r) },
               LaneVectors::size, part);
    }
  });
  list_taut();
  tethers_.carry_on_all(part);
}

bool LaneTensions::has_longer(const LaneNodes& nodes, float stretch, Springs springs) const
{
  ++part_calls()[Part::strain_watch];
  bool found = false;
  in_widest_vectors([&](auto) {
    const float* const at = nodes.data();
    const size_t looked_at = springs == Springs::all ? runs_.size() : taut_.size();
    for (size_t k = 0; k < looked_at && !found; ++k)
    {
      const size_t r = springs == Springs::all ? k : taut_[k];
      const LaneRun& run = runs_[r].springs;
      found = run_has_longer(kept(at + run.place_i), kept(at + run.place_j), kept(reduced_masses_[r]),
                             stretch * rest_lengths_[run.batch]);
    }
  });
  return found;
}

void LaneTensions::add_tensions_to(LaneVectors& pulls) const
{
  tethers_.add_tensions_to(pulls);
  for (size_t r = 0; r < runs_.size(); ++r)
  {
    const LaneRun& springs = runs_[r].springs;
    float* const pull_i = pulls.data() + LaneVectors::place_of(springs.i);
    float* const pull_j = pulls.data() + LaneVectors::place_of(springs.j);
    for (int k = 0; runs_[r].is_taut && k < springs.n; ++k)
    {
      for (const int d : { lane_vector::x, lane_vector::y, lane_vector::z })
      {
        pull_i[d + k] += tensions_of(r)[d + k];
        pull_j[d + k] -= tensions_of(r)[d + k];
      }
    }
  }
}

}  // namespace cloth
