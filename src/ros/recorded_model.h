#pragma once

#include "cloth_sim/ClothTopology.h"
#include "cloth_sim/model/cloth_model.h"

namespace cloth
{

/// The model of a recorded cloth, as far as markers need it: areas, stiffness and damping are not recorded, and stay
/// empty or 0. Springs keep their order. The width of the strip that a chain stands for is not recorded either: it is
/// that of `strip`. Throws RefusedRequest where the lists of `topology` do not fit each other.
ClothModel recorded_model(const cloth_sim::ClothTopology& topology, const SheetProperties& strip);

}  // namespace cloth
