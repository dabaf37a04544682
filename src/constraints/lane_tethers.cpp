#include "lane_tethers.h"

#include "cloth_sim/model/inverse_root.h"
#include "cloth_sim/model/wide_vectors.h"

namespace cloth
{
namespace
{

/// The tethers of a vector of nodes.
struct LaneTethersOf
{
  LaneTethersOf(const LaneNodes& nodes, int first, int anchor)
    : w(nodes.inverse_masses + first)
    , x(nodes.positions[0] + first)
    , y(nodes.positions[1] + first)
    , z(nodes.positions[2] + first)
    , way_x(nodes.ways[0] + first)
    , way_y(nodes.ways[1] + first)
    , way_z(nodes.ways[2] + first)
    , anchor_x(nodes.positions[0][anchor] + nodes.ways[0][anchor])
    , anchor_y(nodes.positions[1][anchor] + nodes.ways[1][anchor])
    , anchor_z(nodes.positions[2][anchor] + nodes.ways[2][anchor])
  {
  }

  const float* w;
  const float* x;
  const float* y;
  const float* z;
  float* way_x;
  float* way_y;
  float* way_z;
  float anchor_x;
  float anchor_y;
  float anchor_z;
};

bool has_taut(const LaneTethersOf& tethers, const float* lengths, float stretch)
{
  int taut = 0;
  for (int k = 0; k < lanes; ++k)
  {
    const float longest = stretch * lengths[k];
    const float x = tethers.anchor_x - tethers.x[k] - tethers.way_x[k];
    const float y = tethers.anchor_y - tethers.y[k] - tethers.way_y[k];
    const float z = tethers.anchor_z - tethers.z[k] - tethers.way_z[k];
    taut |= longest > 0.0F && x * x + y * y + z * z > longest * longest ? 1 : 0;
  }
  return taut != 0;
}

/// Returns whether any is taut.
template <bool fused>
bool relax_some(const LaneTethersOf& tethers, const float* lengths, float stretch, const Columns<float>& tensions,
                float factor)
{
  float* const p_x = tensions[0];
  float* const p_y = tensions[1];
  float* const p_z = tensions[2];
  int taut = 0;
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const float w = tethers.w[k];
    const float longest = stretch * lengths[k];
    const float old_x = factor * p_x[k];
    const float old_y = factor * p_y[k];
    const float old_z = factor * p_z[k];
    const float x = tethers.anchor_x - tethers.x[k] - tethers.way_x[k] + w * old_x;
    const float y = tethers.anchor_y - tethers.y[k] - tethers.way_y[k] + w * old_y;
    const float z = tethers.anchor_z - tethers.z[k] - tethers.way_z[k] + w * old_z;
    const float square = x * x + y * y + z * z;
    const bool is_taut = longest > 0.0F && square > longest * longest && w > 0.0F;
    const float part = is_taut ? (1.0F - longest * inverse_root<fused>(square)) / w : 0.0F;
    tethers.way_x[k] += w * (part * x - old_x);
    tethers.way_y[k] += w * (part * y - old_y);
    tethers.way_z[k] += w * (part * z - old_z);
    p_x[k] = part * x;
    p_y[k] = part * y;
    p_z[k] = part * z;
    taut |= is_taut ? 1 : 0;
  }
  return taut != 0;
}

template <bool fused>
void add_some_shifts(const LaneTethersOf& tethers, const float* lengths, float stretch,
                     const Columns<const float>& tensions, const Columns<float>& shifts, DualParabola<float>& parabola)
{
  const float* const p_x = tensions[0];
  const float* const p_y = tensions[1];
  const float* const p_z = tensions[2];
  float* const shift_x = shifts[0];
  float* const shift_y = shifts[1];
  float* const shift_z = shifts[2];
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const float w = tethers.w[k];
    const float x = tethers.anchor_x - tethers.x[k] - tethers.way_x[k];
    const float y = tethers.anchor_y - tethers.y[k] - tethers.way_y[k];
    const float z = tethers.anchor_z - tethers.z[k] - tethers.way_z[k];
    const float square = p_x[k] * p_x[k] + p_y[k] * p_y[k] + p_z[k] * p_z[k];
    parabola.rise[k] +=
        p_x[k] * x + p_y[k] * y + p_z[k] * z - stretch * lengths[k] * square * inverse_root<fused>(square);
    parabola.curvature[k] += float(DualParabola<float>::compliance) * w * square;
    shift_x[k] += w * p_x[k];
    shift_y[k] += w * p_y[k];
    shift_z[k] += w * p_z[k];
  }
}

Columns<float> moved_on(const Columns<float>& columns, int by)
{
  return { columns[0] + by, columns[1] + by, columns[2] + by };
}

}  // namespace

LaneTethers::LaneTethers(const ClothModel& model, const LaneLayout& layout)
  : layout_(layout)
  , nodes_(model.nodes())
  , has_ways_(has_springs(model, SpringKind::structural))
  , ways_(model)
{
}

void LaneTethers::hold(const std::vector<int>& held)
{
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
    tethers_.push_back(std::move(tether));
  }
}

void LaneTethers::add_shifts(const LaneNodes& nodes, float stretch, const Columns<float>& shifts,
                             DualParabola<float>& parabola) const
{
  in_widest_vectors([&](auto arithmetic) {
    for (const Tether& tether : tethers_)
    {
      for (int node = 0; node < nodes.nodes; node += lanes)
      {
        if (tether.is_taut[static_cast<size_t>(node / lanes)])
        {
          add_some_shifts<arithmetic.has_fused_multiply_add>(LaneTethersOf(nodes, node, tether.node),
                                                             tether.lengths.data() + node, stretch,
                                                             tether.tensions.from(node), moved_on(shifts, node), parabola);
        }
      }
    }
  });
}

void LaneTethers::relax(const LaneNodes& nodes, float stretch, float factor)
{
  const bool looks_at_slack = passes_++ % passes_between_looks == 0;
  in_widest_vectors([&](auto arithmetic) {
    for (Tether& tether : tethers_)
    {
      for (int node = 0; node < nodes.nodes; node += lanes)
      {
        char& is_taut = tether.is_taut[static_cast<size_t>(node / lanes)];
        const LaneTethersOf tethers(nodes, node, tether.node);
        const float* const lengths = tether.lengths.data() + node;
        if (is_taut || (looks_at_slack && has_taut(tethers, lengths, stretch)))
        {
          is_taut = relax_some<arithmetic.has_fused_multiply_add>(tethers, lengths, stretch,
                                                                  tether.tensions.from(node), factor)
                        ? 1
                        : 0;
        }
      }
    }
  });
}

void LaneTethers::add_tensions_to(const Columns<float>& pulls) const
{
  for (const Tether& tether : tethers_)
  {
    for (size_t d = 0; d < 3; ++d)
    {
      const float* const tensions = tether.tensions.from(0)[d];
      for (int node = 0; node < layout_.nodes(); ++node)
      {
        pulls[d][node] += tensions[node];
        pulls[d][tether.node] -= tensions[node];
      }
    }
  }
}

}  // namespace cloth
