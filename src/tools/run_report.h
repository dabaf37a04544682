#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "cloth_sim/scene/choice.h"
#include "cloth_sim/simulation/simulation.h"

namespace cloth
{

/// The line `time,node,x,y,z,vx,vy,vz`.
void write_csv_header(std::ostream& stream);

/// One line a node, 17 significant digits: s, index, m, m/s.
void write_csv_sample(std::ostream& stream, const ClothState& state);

/// The run in YAML: what it cost, how it ended, and the plan. `wall_time` in s.
void write_summary(std::ostream& stream, const Simulation& simulation, double wall_time,
                   const std::vector<std::string>& plan, const Choice& choice);

}  // namespace cloth
