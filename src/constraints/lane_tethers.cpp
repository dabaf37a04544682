#include "lane_tethers.h"

#include "cloth_sim/model/inverse_root.h"
#include "cloth_sim/model/wide_vectors.h"

namespace cloth
{
namespace
{

struct Point
{
  float x;
  float y;
  float z;
};

Point place_of(const LaneNodes& nodes, int node)
{
  using namespace lane_node;
  const float* const at = nodes.data() + LaneNodes::place_of(node);
  return { at[x] + at[way_x], at[y] + at[way_y], at[z] + at[way_z] };
}

bool has_taut(const float* nodes, const Point& anchor, const float* lengths, float stretch)
{
  using namespace lane_node;
  int taut = 0;
  for (int k = 0; k < lanes; ++k)
  {
    const float longest = stretch * lengths[k];
    const float l_x = anchor.x - nodes[x + k] - nodes[way_x + k];
    const float l_y = anchor.y - nodes[y + k] - nodes[way_y + k];
    const float l_z = anchor.z - nodes[z + k] - nodes[way_z + k];
    taut |= longest > 0.0F && l_x * l_x + l_y * l_y + l_z * l_z > longest * longest ? 1 : 0;
  }
  return taut != 0;
}

/// Returns whether any is taut.
template <bool fused>
bool relax_some(float* nodes, const float* masses, const Point& anchor, const float* lengths, float stretch,
                float* tensions, float factor)
{
  using namespace lane_node;
  int taut = 0;
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const float w = nodes[inverse_mass + k];
    const float longest = stretch * lengths[k];
    const float p_x = factor * tensions[lane_vector::x + k];
    const float p_y = factor * tensions[lane_vector::y + k];
    const float p_z = factor * tensions[lane_vector::z + k];
    const float l_x = anchor.x - nodes[x + k] - nodes[way_x + k] + w * p_x;
    const float l_y = anchor.y - nodes[y + k] - nodes[way_y + k] + w * p_y;
    const float l_z = anchor.z - nodes[z + k] - nodes[way_z + k] + w * p_z;
    const float square = l_x * l_x + l_y * l_y + l_z * l_z;
    const bool is_taut = longest > 0.0F && square > longest * longest;
    const float part = is_taut ? (1.0F - longest * inverse_root<fused>(square)) * masses[k] : 0.0F;
    nodes[way_x + k] += w * (part * l_x - p_x);
    nodes[way_y + k] += w * (part * l_y - p_y);
    nodes[way_z + k] += w * (part * l_z - p_z);
    tensions[lane_vector::x + k] = part * l_x;
    tensions[lane_vector::y + k] = part * l_y;
    tensions[lane_vector::z + k] = part * l_z;
    taut |= is_taut ? 1 : 0;
  }
  return taut != 0;
}

template <bool fused>
void add_some_shifts(const float* nodes, const Point& anchor, const float* lengths, float stretch,
                     const float* tensions, float* shifts, DualParabola<float>& parabola)
{
  using namespace lane_node;
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const float w = nodes[inverse_mass + k];
    const float p_x = tensions[lane_vector::x + k];
    const float p_y = tensions[lane_vector::y + k];
    const float p_z = tensions[lane_vector::z + k];
    const float l_x = anchor.x - nodes[x + k] - nodes[way_x + k];
    const float l_y = anchor.y - nodes[y + k] - nodes[way_y + k];
    const float l_z = anchor.z - nodes[z + k] - nodes[way_z + k];
    const float square = p_x * p_x + p_y * p_y + p_z * p_z;
    parabola.rise[k] += p_x * l_x + p_y * l_y + p_z * l_z - stretch * lengths[k] * square * inverse_root<fused>(square);
    parabola.curvature[k] += float(DualParabola<float>::compliance) * w * square;
    shifts[lane_vector::x + k] += w * p_x;
    shifts[lane_vector::y + k] += w * p_y;
    shifts[lane_vector::z + k] += w * p_z;
  }
}

}  // namespace

LaneTethers::LaneTethers(const ClothModel& model, const LaneLayout& layout)
  : layout_(layout), nodes_(model.nodes()), has_ways_(has_springs(model, SpringKind::structural)), ways_(model)
{
}

void LaneTethers::prepare(const LaneNodes& nodes, const std::vector<int>& held)
{
  masses_.assign(static_cast<size_t>(layout_.nodes()), 0.0F);
  for (int node = 0; node < layout_.nodes(); ++node)
  {
    const float w = nodes.data()[LaneNodes::place_of(node) + lane_node::inverse_mass];
    masses_[static_cast<size_t>(node)] = w > 0.0F ? 1.0F / w : 0.0F;
  }
  if (held == held_)
  {
    return;
  }
  held_ = held;
  tethers_.clear();
  if (!has_ways_ || held.size() > most)
  {
    return;
  }
  for (const int node : held)
  {
    Tether tether;
    tether.node = layout_[node];
    tether.lengths.assign(static_cast<size_t>(layout_.nodes()), 0.0F);
    for (int other = 0; other < nodes_; ++other)
    {
      tether.lengths[static_cast<size_t>(layout_[other])] = static_cast<float>(ways_.between(node, other));
    }
    tether.tensions.set_zero(layout_.nodes());
    tether.is_taut.assign(static_cast<size_t>(layout_.nodes() / lanes), 0);
    tether.last_tensions = tether.tensions;
    tether.was_taut = tether.is_taut;
    tethers_.push_back(std::move(tether));
  }
}

void LaneTethers::add_shifts(const LaneNodes& nodes, float stretch, LaneVectors& shifts,
                             DualParabola<float>& parabola) const
{
  in_widest_vectors([&](auto arithmetic) {
    for (const Tether& tether : tethers_)
    {
      const Point anchor = place_of(nodes, tether.node);
      for (int v = 0; v < layout_.nodes() / lanes; ++v)
      {
        if (tether.is_taut[static_cast<size_t>(v)])
        {
          add_some_shifts<arithmetic.has_fused_multiply_add>(
              nodes.data() + v * LaneNodes::size, anchor, tether.lengths.data() + v * lanes, stretch,
              tether.tensions.data() + v * LaneVectors::size, shifts.data() + v * LaneVectors::size, parabola);
        }
      }
    }
  });
}

void LaneTethers::relax(LaneNodes& nodes, float stretch, float factor)
{
  const bool looks_at_slack = passes_++ % passes_between_looks == 0;
  in_widest_vectors([&](auto arithmetic) {
    for (Tether& tether : tethers_)
    {
      const Point anchor = place_of(nodes, tether.node);
      for (int v = 0; v < layout_.nodes() / lanes; ++v)
      {
        char& is_taut = tether.is_taut[static_cast<size_t>(v)];
        float* const some = nodes.data() + v * LaneNodes::size;
        const float* const lengths = tether.lengths.data() + v * lanes;
        if (is_taut || (looks_at_slack && has_taut(some, anchor, lengths, stretch)))
        {
          const bool stays_taut =
              relax_some<arithmetic.has_fused_multiply_add>(some, masses_.data() + v * lanes, anchor, lengths, stretch,
                                                            tether.tensions.data() + v * LaneVectors::size, factor);
          is_taut = stays_taut ? 1 : 0;
        }
      }
    }
  });
}

void LaneTethers::begin_momentum()
{
  for (Tether& tether : tethers_)
  {
    tether.last_tensions = tether.tensions;
    tether.was_taut = tether.is_taut;
  }
}

void LaneTethers::carry_on_all(float part)
{
  in_widest_vectors([&](auto) {
    for (Tether& tether : tethers_)
    {
      for (size_t v = 0; v < tether.is_taut.size(); ++v)
      {
        carry_on(tether.is_taut[v], tether.was_taut[v], std::array{ tether.tensions.data() + v * LaneVectors::size },
                 std::array{ tether.last_tensions.data() + v * LaneVectors::size }, LaneVectors::size, part);
      }
    }
  });
}

void LaneTethers::add_tensions_to(LaneVectors& pulls) const
{
  for (const Tether& tether : tethers_)
  {
    float* const on_anchor = pulls.data() + LaneVectors::place_of(tether.node);
    for (int node = 0; node < layout_.nodes(); ++node)
    {
      const float* const tension = tether.tensions.data() + LaneVectors::place_of(node);
      float* const pull = pulls.data() + LaneVectors::place_of(node);
      for (const int d : { lane_vector::x, lane_vector::y, lane_vector::z })
      {
        pull[d] += tension[d];
        on_anchor[d] -= tension[d];
      }
    }
  }
}

}  // namespace cloth
