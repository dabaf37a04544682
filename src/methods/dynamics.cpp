#include "cloth_sim/methods/dynamics.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/model/wide_vectors.h"

namespace cloth
{

Dynamics::Dynamics(ClothModel model, const Eigen::Vector3d& gravity, const AirProperties& air)
  : model_(std::move(model))
  , gravity_(gravity)
  , air_(air)
  , pins_(model_.nodes())
  , inverse_masses_(model_.masses.array().inverse())
  , longest_reach_(longest_reach(model_))
{
  air_.make_room_for(model_);
}

void Dynamics::use_threads(int threads)
{
  crew_ = threads > 1 ? std::make_unique<Crew>(threads) : nullptr;
}

NodeRange Dynamics::band_of(int thread) const
{
  const std::int64_t length = stretch_length(model_);
  const std::int64_t stretches = (model_.nodes() + length - 1) / length;
  const auto begin_of = [&](std::int64_t t) {
    return static_cast<int>(std::min<std::int64_t>(stretches * t / crew_->threads() * length, model_.nodes()));
  };
  return { begin_of(thread), begin_of(thread + 1) };
}

void Dynamics::external_forces(double /*time*/, NodeRange nodes, Vectors& forces) const
{
  if (gravity_.isZero(0.0))
  {
    forces.middleRows(nodes.begin, nodes.size()).setZero();
    return;
  }
  part_calls()[Part::gravity] += nodes.begin == 0 ? 1 : 0;
  in_widest_vectors([&](auto) {
    const double* const masses = model_.masses.data();
    for (int d = 0; d < 3; ++d)
    {
      const double gravity = gravity_[d];
      double* const rows = forces.col(d).data();
#pragma GCC ivdep
      for (int i = nodes.begin; i < nodes.end; ++i)
      {
        rows[i] = gravity * masses[i];
      }
    }
  });
}

void Dynamics::external_forces_on_all(double time, Vectors& forces) const
{
  forces.resize(model_.nodes(), 3);
  external_forces(time, all_nodes(model_), forces);
}

void Dynamics::forces_without_air(double time, const Vectors& positions, const Vectors& velocities,
                                  Vectors& forces) const
{
  forces.resize(model_.nodes(), 3);
  for_each_band(
      [&](NodeRange band) { forces_without_air(time, positions, velocities, band, forces, [](NodeRange) {}); });
}

void Dynamics::forces(double time, const Vectors& positions, const Vectors& velocities, Vectors& forces) const
{
  forces.resize(model_.nodes(), 3);
  for_each_band([&](NodeRange band) {
    forces_without_air(time, positions, velocities, band, forces,
                       [&](NodeRange nodes) { air_.add_forces(model_, time, positions, velocities, nodes, forces); });
  });
}

void Dynamics::unheld_accelerations_of(const Vectors& forces, Vectors& accelerations) const
{
  accelerations = forces.array().colwise() * inverse_masses_;
}

void Dynamics::accelerations_of(const Vectors& forces, Vectors& accelerations) const
{
  unheld_accelerations_of(forces, accelerations);
  pins_.clear_held(accelerations);
}

void Dynamics::accelerations(double time, const Vectors& positions, const Vectors& velocities,
                             Vectors& accelerations) const
{
  unheld_accelerations(time, positions, velocities, accelerations);
  pins_.clear_held(accelerations);
}

void Dynamics::unheld_accelerations(double time, const Vectors& positions, const Vectors& velocities,
                                    Vectors& accelerations) const
{
  accelerations.resize(model_.nodes(), 3);
  for_each_band([&](NodeRange band) {
    forces_without_air(time, positions, velocities, band, accelerations, [&](NodeRange nodes) {
      air_.add_forces(model_, time, positions, velocities, nodes, accelerations);
      divide_by_masses(nodes, accelerations);
    });
  });
}

void Dynamics::divide_by_masses(NodeRange nodes, Vectors& forces) const
{
  in_widest_vectors([&](auto) {
    const double* const inverse_masses = inverse_masses_.data();
    for (int d = 0; d < 3; ++d)
    {
      double* const rows = forces.col(d).data();
#pragma GCC ivdep
      for (int i = nodes.begin; i < nodes.end; ++i)
      {
        rows[i] *= inverse_masses[i];
      }
    }
  });
}

}  // namespace cloth
