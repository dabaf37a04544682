#pragma once

#include <string>

#include "cloth_sim/scene/choice.h"

#include "started_scene.h"
#include "step_costs.h"

namespace cloth
{

/// In words the coarsest grid whose answer differs from that of one twice as fine by less than solver.tolerance, in its
/// motion over `Motion::horizon` and in the shape in which it comes to rest where it has one, with the time that it
/// would save beside `choice`; or that none was found among those with fewer cells than the scene's. Compared are nodes
/// that both grids have, root mean square. Throws SceneError where a scene cannot be stepped.
std::string grid_report(const StartedScene& scene, const Choice& choice, StepCosts& costs);

}  // namespace cloth
