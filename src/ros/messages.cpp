#include "messages.h"

#include <algorithm>

#include "cloth_sim/forces/springs.h"

#include "conversions.h"

namespace cloth
{
namespace
{

std::uint8_t code_of(SpringKind kind)
{
  switch (kind)
  {
    case SpringKind::structural:
      return cloth_sim::ClothTopology::STRUCTURAL;
    case SpringKind::shear:
      return cloth_sim::ClothTopology::SHEAR;
    default:
      return cloth_sim::ClothTopology::FLEX;
  }
}

}  // namespace

cloth_sim::ClothTopology topology_message(const ClothModel& model, std::uint32_t version)
{
  cloth_sim::ClothTopology message;
  message.version = version;
  message.rows = static_cast<std::uint32_t>(model.rows);
  message.cols = static_cast<std::uint32_t>(model.cols);
  to_float32(model.rest_positions, message.rest_positions);
  message.masses.assign(model.masses.begin(), model.masses.end());
  for (const auto& triangle : triangles_of(model))
  {
    message.triangles.insert(message.triangles.end(), triangle.begin(), triangle.end());
  }
  for (const SpringBatch& batch : model.springs)
  {
    for_each_spring(batch, [&](int i, int j) {
      message.spring_nodes.push_back(static_cast<std::uint32_t>(i));
      message.spring_nodes.push_back(static_cast<std::uint32_t>(j));
      message.spring_kinds.push_back(code_of(batch.kind));
      message.rest_lengths.push_back(static_cast<float>(batch.rest_length));
    });
  }
  return message;
}

void fill_state(const Simulation& simulation, cloth_sim::ClothState& message)
{
  const ClothState& state = simulation.state();
  message.step = simulation.counters().steps;
  message.sim_time = state.time;
  to_float32(state.positions, message.positions);
  to_float32(state.velocities, message.velocities);
  message.flags.assign(static_cast<size_t>(simulation.model().nodes()), 0);
  for (const Pin& pin : simulation.pins().all())
  {
    for (const int node : pin.nodes)
    {
      message.flags[static_cast<size_t>(node)] |= cloth_sim::ClothState::PINNED;
    }
  }
}

cloth_sim::ClothStats stats_message(const Simulation& simulation, const TickReport& ticks)
{
  const Energies energies = energies_of(simulation.dynamics(), simulation.state());
  cloth_sim::ClothStats message;
  message.step = simulation.counters().steps;
  message.sim_time = simulation.state().time;
  message.real_time_factor = ticks.real_time_factor;
  message.tick_ms_mean = ticks.tick_ms_mean;
  message.tick_ms_max = ticks.tick_ms_max;
  message.kinetic_energy = energies.kinetic;
  message.elastic_energy = energies.elastic;
  message.gravitational_energy = energies.gravitational;
  message.max_strain = max_strain(simulation.model(), simulation.state().positions);
  message.time_step = simulation.time_step();
  message.stability_limit = simulation.stability_limit();
  message.rejected_steps = simulation.counters().rejected_steps;
  message.unconverged_steps = simulation.counters().unconverged_steps;
  message.method = simulation.method().name;
  return message;
}

}  // namespace cloth
