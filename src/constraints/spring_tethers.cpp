#include "spring_tethers.h"

#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>

#include "cloth_sim/model/inverse_root.h"
#include "cloth_sim/model/wide_vectors.h"

namespace cloth
{
namespace
{

constexpr int lanes = lanes_of<double>;

/// A vector of nodes from `first` on, and the ends that their tethers are held by.
struct Nodes
{
  Nodes(const Columns<double>& positions, int first, int anchor)
    : x(positions[0] + first)
    , y(positions[1] + first)
    , z(positions[2] + first)
    , anchor_x(positions[0][anchor])
    , anchor_y(positions[1][anchor])
    , anchor_z(positions[2][anchor])
  {
  }

  double* x;
  double* y;
  double* z;
  double anchor_x;
  double anchor_y;
  double anchor_z;
};

bool has_taut(const Nodes& nodes, const double* lengths, double stretch)
{
  std::int64_t taut = 0;
  for (int k = 0; k < lanes; ++k)
  {
    const double longest = stretch * lengths[k];
    const double l_x = nodes.anchor_x - nodes.x[k];
    const double l_y = nodes.anchor_y - nodes.y[k];
    const double l_z = nodes.anchor_z - nodes.z[k];
    taut |= longest > 0.0 && l_x * l_x + l_y * l_y + l_z * l_z > longest * longest ? 1 : 0;
  }
  return taut != 0;
}

/// Returns whether any is taut.
template <bool fused>
bool relax_some(const Nodes& nodes, const double* inverse_masses, const double* lengths, double stretch,
                const Columns<double>& tensions, double factor)
{
  std::int64_t taut = 0;
  double* const tensions_x = tensions[0];
  double* const tensions_y = tensions[1];
  double* const tensions_z = tensions[2];
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const double w = inverse_masses[k];
    const double longest = stretch * lengths[k];
    const double p_x = factor * tensions_x[k];
    const double p_y = factor * tensions_y[k];
    const double p_z = factor * tensions_z[k];
    const double l_x = nodes.anchor_x - nodes.x[k] + w * p_x;
    const double l_y = nodes.anchor_y - nodes.y[k] + w * p_y;
    const double l_z = nodes.anchor_z - nodes.z[k] + w * p_z;
    const double square = l_x * l_x + l_y * l_y + l_z * l_z;
    const bool is_taut = longest > 0.0 && square > longest * longest;
    const double part = is_taut ? (1.0 - longest * inverse_root<fused>(square)) / w : 0.0;
    nodes.x[k] += w * (part * l_x - p_x);
    nodes.y[k] += w * (part * l_y - p_y);
    nodes.z[k] += w * (part * l_z - p_z);
    tensions_x[k] = part * l_x;
    tensions_y[k] = part * l_y;
    tensions_z[k] = part * l_z;
    taut |= is_taut ? 1 : 0;
  }
  return taut != 0;
}

template <bool fused>
void add_some_shifts(const Nodes& nodes, const double* inverse_masses, const double* lengths, double stretch,
                     const Columns<const double>& tensions, const Columns<double>& shifts,
                     DualParabola<double>& parabola)
{
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const double w = inverse_masses[k];
    const double p_x = tensions[0][k];
    const double p_y = tensions[1][k];
    const double p_z = tensions[2][k];
    const double l_x = nodes.anchor_x - nodes.x[k];
    const double l_y = nodes.anchor_y - nodes.y[k];
    const double l_z = nodes.anchor_z - nodes.z[k];
    const double square = p_x * p_x + p_y * p_y + p_z * p_z;
    parabola.rise[k] += p_x * l_x + p_y * l_y + p_z * l_z - stretch * lengths[k] * square * inverse_root<fused>(square);
    parabola.curvature[k] += DualParabola<double>::compliance * w * square;
    shifts[0][k] += w * p_x;
    shifts[1][k] += w * p_y;
    shifts[2][k] += w * p_z;
  }
}

}  // namespace

SpringTethers::SpringTethers(const ClothModel& model)
  : nodes_(model.nodes()), has_ways_(has_springs(model, SpringKind::structural)), ways_(model)
{
}

void SpringTethers::prepare(const Eigen::VectorXd& inverse_masses)
{
  std::vector<int> held;
  for (int node = 0; node < nodes_; ++node)
  {
    if (inverse_masses[node] == 0.0)
    {
      held.push_back(node);
    }
  }
  if (held == held_)
  {
    return;
  }
  held_ = std::move(held);
  tethers_.clear();
  if (!has_ways_ || held_.size() > most)
  {
    return;
  }
  for (const int node : held_)
  {
    Tether tether;
    tether.node = node;
    tether.lengths.assign(static_cast<size_t>(nodes_ + row_padding), 0.0);
    for (int other = 0; other < nodes_; ++other)
    {
      tether.lengths[static_cast<size_t>(other)] = inverse_masses[other] > 0.0 ? ways_.between(node, other) : 0.0;
    }
    tether.tensions.set_zero(nodes_);
    tether.is_taut.assign(static_cast<size_t>((nodes_ + lanes - 1) / lanes), 0);
    tethers_.push_back(std::move(tether));
  }
}

void SpringTethers::go_on_from(const SpringTethers& before)
{
  if (has_ways_ && before.has_ways_)
  {
    held_ = before.held_;
    tethers_ = before.tethers_;
  }
}

void SpringTethers::add_shifts(const double* inverse_masses, const Columns<double>& positions, double stretch,
                               const Columns<double>& shifts, DualParabola<double>& parabola) const
{
  in_widest_vectors([&](auto arithmetic) {
    for (const Tether& tether : tethers_)
    {
      for (size_t v = 0; v < tether.is_taut.size(); ++v)
      {
        const int first = static_cast<int>(v) * lanes;
        if (tether.is_taut[v])
        {
          add_some_shifts<arithmetic.has_fused_multiply_add>(
              Nodes(positions, first, tether.node), inverse_masses + first, tether.lengths.data() + first, stretch,
              tether.tensions.from(first), { shifts[0] + first, shifts[1] + first, shifts[2] + first }, parabola);
        }
      }
    }
  });
}

bool SpringTethers::relax(const double* inverse_masses, const Columns<double>& positions, double stretch, double factor)
{
  bool is_any = false;
  in_widest_vectors([&](auto arithmetic) {
    for (Tether& tether : tethers_)
    {
      for (size_t v = 0; v < tether.is_taut.size(); ++v)
      {
        const int first = static_cast<int>(v) * lanes;
        const Nodes nodes(positions, first, tether.node);
        const double* const lengths = tether.lengths.data() + first;
        if (tether.is_taut[v] || has_taut(nodes, lengths, stretch))
        {
          is_any = true;
          const bool stays_taut = relax_some<arithmetic.has_fused_multiply_add>(
              nodes, inverse_masses + first, lengths, stretch, tether.tensions.from(first), factor);
          tether.is_taut[v] = stays_taut ? 1 : 0;
        }
      }
    }
  });
  return is_any;
}

void SpringTethers::add_tensions_to(const Columns<double>& pulls) const
{
  for (const Tether& tether : tethers_)
  {
    const Columns<const double> tensions = tether.tensions.from(0);
    for (size_t d = 0; d < 3; ++d)
    {
      pulls[d][tether.node] = std::accumulate(tensions[d], tensions[d] + nodes_, pulls[d][tether.node], std::minus<>());
    }
  }
}

}  // namespace cloth
