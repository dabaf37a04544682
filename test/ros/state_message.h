#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include "cloth_sim/ClothState.h"

namespace cloth
{

inline Eigen::Vector3d position_of(const cloth_sim::ClothState& state, size_t node)
{
  return { state.positions[3 * node], state.positions[3 * node + 1], state.positions[3 * node + 2] };
}

inline Eigen::Vector3d velocity_of(const cloth_sim::ClothState& state, size_t node)
{
  return { state.velocities[3 * node], state.velocities[3 * node + 1], state.velocities[3 * node + 2] };
}

/// Of all nodes.
inline Eigen::Vector3d mean_position(const cloth_sim::ClothState& state)
{
  const size_t nodes = state.flags.size();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (size_t node = 0; node < nodes; ++node)
  {
    sum += position_of(state, node);
  }
  return sum / static_cast<double>(nodes);
}

inline bool is_pinned(const cloth_sim::ClothState& state, size_t node)
{
  return (state.flags[node] & cloth_sim::ClothState::PINNED) != 0;
}

inline size_t pinned_nodes(const cloth_sim::ClothState& state)
{
  return static_cast<size_t>(std::count_if(state.flags.begin(), state.flags.end(), [](std::uint8_t flags) {
    return (flags & cloth_sim::ClothState::PINNED) != 0;
  }));
}

}  // namespace cloth
