#pragma once

#include <string>

#include <ros/time.h>

#include "cloth_sim/ClothState.h"
#include "cloth_sim/ClothStats.h"
#include "cloth_sim/ClothTopology.h"
#include "cloth_sim/model/cloth_model.h"
#include "cloth_sim/simulation/simulation.h"

#include "tick_statistics.h"

namespace cloth
{

cloth_sim::ClothTopology topology_message(const ClothModel& model, std::uint32_t version);

/// Puts the state of `simulation` into `message`, whose memory is used again; its header stays.
void fill_state(const Simulation& simulation, cloth_sim::ClothState& message);

/// What the simulation and the last period of ticks amount to; header, overruns, paused and plan are left to the
/// caller.
cloth_sim::ClothStats stats_message(const Simulation& simulation, const TickReport& ticks);

}  // namespace cloth
