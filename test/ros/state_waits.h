#pragma once

#include <cmath>

#include "cloth_sim/ClothState.h"

#include "listener.h"
#include "time_services.h"

namespace cloth
{

/// Resets /cloth_node, which runs, and waits for a state of after that: others may still be on their way.
inline bool start_over(Listener<cloth_sim::ClothState>& states)
{
  if (!states.wait_for_one([](const cloth_sim::ClothState& state) { return state.sim_time > 0.0; }))
  {
    return false;
  }
  const double before = states.last().sim_time;
  return trigger("reset").success != 0 &&
         states.wait_for_one([=](const cloth_sim::ClothState& state) { return state.sim_time < before; });
}

/// Waits for what a paused cloth publishes again; others may still be on their way before.
inline bool wait_for_standstill(Listener<cloth_sim::ClothState>& states)
{
  double time = std::nan("");
  return states.wait_for_one([&](const cloth_sim::ClothState& state) {
    const bool stands = state.sim_time == time;
    time = state.sim_time;
    return stands;
  });
}

}  // namespace cloth
