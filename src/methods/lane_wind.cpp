#include "lane_wind.h"

#include "cloth_sim/model/inverse_root.h"
#include "cloth_sim/model/wide_vectors.h"

namespace cloth
{
namespace
{

/// Adds (x_b - x_c) x (x_d - x_a) of n quads to the normals of their nodes: a, b, c, d are the nodes' positions, and
/// n_a and so on their normals.
void add_normals(const float* a, const float* b, const float* c, const float* d, int n, float* n_a, float* n_b,
                 float* n_c, float* n_d)
{
  using lane_node::x;
  using lane_node::y;
  using lane_node::z;
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const float p_x = b[x + k] - c[x + k];
    const float p_y = b[y + k] - c[y + k];
    const float p_z = b[z + k] - c[z + k];
    const float q_x = d[x + k] - a[x + k];
    const float q_y = d[y + k] - a[y + k];
    const float q_z = d[z + k] - a[z + k];
    const float there = k < n ? 1.0F : 0.0F;
    const float n_x = there * (p_y * q_z - p_z * q_y);
    const float n_y = there * (p_z * q_x - p_x * q_z);
    const float n_z = there * (p_x * q_y - p_y * q_x);
    for (float* const normal : { n_a, n_b, n_c, n_d })
    {
      normal[lane_vector::x + k] += n_x;
      normal[lane_vector::y + k] += n_y;
      normal[lane_vector::z + k] += n_z;
    }
  }
}

/// Leaves normals of 0 behind.
template <bool fused>
void blow_at(float* node, float* normal, const float* shares, float air_x, float air_y, float air_z)
{
  using namespace lane_node;
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const float n_x = normal[lane_vector::x + k];
    const float n_y = normal[lane_vector::y + k];
    const float n_z = normal[lane_vector::z + k];
    const float inverse = inverse_root<fused>(n_x * n_x + n_y * n_y + n_z * n_z);
    const float difference =
        n_x * (air_x - node[way_x + k]) + n_y * (air_y - node[way_y + k]) + n_z * (air_z - node[way_z + k]);
    const float part = shares[k] * (inverse * difference) * inverse;
    node[way_x + k] += part * n_x;
    node[way_y + k] += part * n_y;
    node[way_z + k] += part * n_z;
    normal[lane_vector::x + k] = 0.0F;
    normal[lane_vector::y + k] = 0.0F;
    normal[lane_vector::z + k] = 0.0F;
  }
}

}  // namespace

LaneWind::LaneWind(const ClothModel& model, const LaneLayout& layout) : vectors_(layout.nodes() / lanes)
{
  if (model.is_chain())
  {
    return;
  }
  SpringBatch diagonals{};  // from a to d of all quads
  diagonals.kind = SpringKind::shear;
  diagonals.offset = model.cols + 1;
  const int below = layout.number(1, 0) - layout.number(0, 0);
  for (const SpringRun& run : layout.runs({ diagonals }, rows_a_band))
  {
    const int d = run.node + run.offset;
    quads_.push_back({ run.node, d - below, run.node + below, d, run.n });
  }
  normals_.set_zero(layout.nodes());
  shares_.set_zero(layout.nodes());
}

void LaneWind::prepare(const ClothModel& model, const AirProperties& air, double h, const LaneLayout& layout,
                       const LaneNodes& nodes)
{
  for (int node = 0; node < model.nodes(); ++node)
  {
    const int number = layout[node];
    const bool is_held = nodes.data()[LaneNodes::place_of(number) + lane_node::inverse_mass] == 0.0F;
    const double coupled = h * air.wind_coupling * model.areas[node];
    const double inertia = model.masses[node] + h * air.viscous_damping * model.areas[node];
    shares_.data()[LaneBlocks<1>::place_of(number)] =
        is_held ? 0.0F : static_cast<float>(coupled / (inertia + coupled));
  }
}

void LaneWind::blow(const Eigen::Vector3f& way, LaneNodes& nodes)
{
  in_widest_vectors([&](auto arithmetic) { blow_in_vectors<arithmetic.has_fused_multiply_add>(way, nodes.data()); });
}

template <bool fused>
void LaneWind::blow_in_vectors(const Eigen::Vector3f& way, float* nodes)
{
  float* const normals = normals_.data();
  for (const Quads& quads : quads_)
  {
    add_normals(kept(nodes + LaneNodes::place_of(quads.a)), kept(nodes + LaneNodes::place_of(quads.b)),
                kept(nodes + LaneNodes::place_of(quads.c)), kept(nodes + LaneNodes::place_of(quads.d)), quads.n,
                kept(normals + LaneVectors::place_of(quads.a)), kept(normals + LaneVectors::place_of(quads.b)),
                kept(normals + LaneVectors::place_of(quads.c)), kept(normals + LaneVectors::place_of(quads.d)));
  }
  for (int v = 0; v < vectors_; ++v)
  {
    blow_at<fused>(kept(nodes + v * LaneNodes::size), kept(normals + v * LaneVectors::size),
                   kept(shares_.data() + v * lanes), way[0], way[1], way[2]);
  }
}

}  // namespace cloth
