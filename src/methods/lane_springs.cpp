#include "lane_springs.h"

#include "cloth_sim/model/wide_vectors.h"

namespace cloth
{
namespace
{

/// i and j: the ends in the blocks of nodes, pull_i and pull_j in those of what they are given.
template <bool fused, bool records, bool damped>
void correct_run(float* i, float* j, const Gains<float>& gains, const float* yields, float* pull_i, float* pull_j)
{
  using namespace lane_node;
  const float rest_length = gains.rest_length;
  const float damping = gains.damping;
#pragma GCC ivdep
  for (int k = 0; k < lanes; ++k)
  {
    const float way_x_i = i[way_x + k];
    const float way_y_i = i[way_y + k];
    const float way_z_i = i[way_z + k];
    const float way_x_j = j[way_x + k];
    const float way_y_j = j[way_y + k];
    const float way_z_j = j[way_z + k];
    const float d_x = way_x_j - way_x_i;
    const float d_y = way_y_j - way_y_i;
    const float d_z = way_z_j - way_z_i;
    const float l_x = j[x + k] - i[x + k] + d_x;
    const float l_y = j[y + k] - i[y + k] + d_y;
    const float l_z = j[z + k] - i[z + k] + d_z;
    const float square = l_x * l_x + l_y * l_y + l_z * l_z;
    const float lambda = damped ? correction<fused>(square, l_x * d_x + l_y * d_y + l_z * d_z, rest_length, damping) :
                                  correction<fused>(square, rest_length);
    const float part = yields[k] * lambda;
    const float part_i = i[inverse_mass + k] * part;
    const float part_j = j[inverse_mass + k] * part;
    i[way_x + k] = way_x_i + part_i * l_x;
    i[way_y + k] = way_y_i + part_i * l_y;
    i[way_z + k] = way_z_i + part_i * l_z;
    j[way_x + k] = way_x_j - part_j * l_x;
    j[way_y + k] = way_y_j - part_j * l_y;
    j[way_z + k] = way_z_j - part_j * l_z;
    if constexpr (records)
    {
      add_to_ends(pull_i, pull_j, k, l_x, l_y, l_z, part, part);
    }
  }
}

}  // namespace

LaneSprings::LaneSprings(const ClothModel& model, const LaneLayout& layout)
{
  for (const SpringRun& run : layout.runs(model.springs, rows_a_band))
  {
    if (stretches_.empty() || stretches_.back().batch != run.batch)
    {
      stretches_.push_back({ run.batch, runs_.size(), runs_.size() });
    }
    runs_.emplace_back(run);
    stretches_.back().end = runs_.size();
  }
}

void LaneSprings::prepare(const ClothModel& model, double compliance, double h, const LaneNodes& nodes)
{
  gains_.clear();
  for (const SpringBatch& batch : model.springs)
  {
    gains_.push_back(gains_of<float>(batch, compliance, h));
  }
  yields_.clear();
  for (const LaneRun& run : runs_)
  {
    yields_.add(numbers_of_springs(nodes, run, [&](float w) { return 1.0F / resistance(gains_[run.batch], w); }));
  }
}

void LaneSprings::correct(LaneNodes& nodes, LaneVectors* pulls) const
{
  in_widest_vectors([&](auto arithmetic) {
    constexpr bool fused = arithmetic.has_fused_multiply_add;
    if (pulls != nullptr)
    {
      correct_all<fused, true>(nodes.data(), pulls->data());
    }
    else
    {
      correct_all<fused, false>(nodes.data(), nullptr);
    }
  });
}

template <bool fused, bool records>
void LaneSprings::correct_all(float* nodes, float* pulls) const
{
  for (const Stretch& stretch : stretches_)
  {
    if (gains_[stretch.batch].damping > 0.0F)
    {
      correct_stretch<fused, records, true>(stretch, nodes, pulls);
    }
    else
    {
      correct_stretch<fused, records, false>(stretch, nodes, pulls);
    }
  }
}

template <bool fused, bool records, bool damped>
void LaneSprings::correct_stretch(const Stretch& stretch, float* nodes, float* pulls) const
{
  const Gains<float> gains = gains_[stretch.batch];
  for (size_t r = stretch.begin; r < stretch.end; ++r)
  {
    const LaneRun& run = runs_[r];
    float* const pull_i = records ? pulls + LaneVectors::place_of(run.i) : nullptr;
    float* const pull_j = records ? pulls + LaneVectors::place_of(run.j) : nullptr;
    correct_run<fused, records, damped>(kept(nodes + run.place_i), kept(nodes + run.place_j), gains, kept(yields_[r]),
                                        pull_i, pull_j);
  }
}

}  // namespace cloth
