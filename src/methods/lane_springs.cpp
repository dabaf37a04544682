#include "lane_springs.h"

#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/wide_vectors.h"

namespace cloth
{
namespace
{

template <bool fused, bool records>
void correct_run(const LaneEnds& ends, const Gains<float>& gains, const float* yields, const LaneEnds& pulled)
{
  const float rest_length = gains.rest_length;
  const float damping = gains.damping;
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const float way_x_i = ends.way_x_i[k];
    const float way_y_i = ends.way_y_i[k];
    const float way_z_i = ends.way_z_i[k];
    const float way_x_j = ends.way_x_j[k];
    const float way_y_j = ends.way_y_j[k];
    const float way_z_j = ends.way_z_j[k];
    const float way_x = way_x_j - way_x_i;
    const float way_y = way_y_j - way_y_i;
    const float way_z = way_z_j - way_z_i;
    const float x = ends.x_j[k] - ends.x_i[k] + way_x;
    const float y = ends.y_j[k] - ends.y_i[k] + way_y;
    const float z = ends.z_j[k] - ends.z_i[k] + way_z;
    const float part = yields[k] * correction<fused>(x * x + y * y + z * z, x * way_x + y * way_y + z * way_z,
                                                     rest_length, damping);
    const float part_i = ends.w_i[k] * part;
    const float part_j = ends.w_j[k] * part;
    ends.way_x_i[k] = way_x_i + part_i * x;
    ends.way_y_i[k] = way_y_i + part_i * y;
    ends.way_z_i[k] = way_z_i + part_i * z;
    ends.way_x_j[k] = way_x_j - part_j * x;
    ends.way_y_j[k] = way_y_j - part_j * y;
    ends.way_z_j[k] = way_z_j - part_j * z;
    if constexpr (records)
    {
      const float x_i = pulled.way_x_i[k] + part * x;
      const float y_i = pulled.way_y_i[k] + part * y;
      const float z_i = pulled.way_z_i[k] + part * z;
      const float x_j = pulled.way_x_j[k] - part * x;
      const float y_j = pulled.way_y_j[k] - part * y;
      const float z_j = pulled.way_z_j[k] - part * z;
      pulled.way_x_i[k] = x_i;
      pulled.way_y_i[k] = y_i;
      pulled.way_z_i[k] = z_i;
      pulled.way_x_j[k] = x_j;
      pulled.way_y_j[k] = y_j;
      pulled.way_z_j[k] = z_j;
    }
  }
}

}  // namespace

LaneSprings::LaneSprings(const ClothModel& model, const LaneLayout& layout)
  : runs_(layout.runs(model.springs, rows_a_band))
{
}

void LaneSprings::prepare(const ClothModel& model, double compliance, double h, const float* inverse_masses)
{
  gains_.clear();
  for (const SpringBatch& batch : model.springs)
  {
    gains_.push_back(gains_of<float>(batch, compliance, h));
  }
  yields_.clear();
  for (const SpringRun& run : runs_)
  {
    LaneTable::Row yields{};
    for (int k = 0; k < run.n; ++k)
    {
      const float w = inverse_masses[run.node + k] + inverse_masses[run.node + run.offset + k];
      yields[static_cast<size_t>(k)] = w > 0.0F ? 1.0F / resistance(gains_[run.batch], w) : 0.0F;
    }
    yields_.add(yields);
  }
}

void LaneSprings::correct(const LaneNodes& nodes, AlignedVectors<float>* pulls) const
{
  in_widest_vectors([&](auto arithmetic) {
    constexpr bool fused = arithmetic.has_fused_multiply_add;
    if (pulls != nullptr)
    {
      correct_all<fused, true>(nodes, pulls->from(0));
    }
    else
    {
      correct_all<fused, false>(nodes, nodes.ways);
    }
  });
}

template <bool fused, bool records>
void LaneSprings::correct_all(const LaneNodes& nodes, const Columns<float>& pulls) const
{
  const LaneNodes pulled{ nodes.inverse_masses, nodes.positions, pulls, nodes.nodes };
  for (size_t r = 0; r < runs_.size(); ++r)
  {
    const SpringRun& run = runs_[r];
    correct_run<fused, records>(LaneEnds(nodes, run), gains_[run.batch], yields_[r], LaneEnds(pulled, run));
  }
}

}  // namespace cloth
