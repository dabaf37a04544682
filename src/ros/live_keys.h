#pragma once

#include <string>
#include <vector>

#include <dynamic_reconfigure/Config.h>

#include "cloth_sim/scene/parameter_table.h"
#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// What dynamic_reconfigure calls a live key, `_` for `.`: springs_flex_damping; of a list one name a number:
/// air_wind_x, air_wind_y, air_wind_z.
std::vector<std::string> flat_names_of(const Parameter<SceneParams>& parameter);

/// The values of all live keys by their flat names.
dynamic_reconfigure::Config live_values_of(const SceneParams& scene);

/// `scene` with those live keys that `values` has; a number out of range becomes the nearest that is allowed. Throws
/// SceneError, as the scene's reader does, for numbers that are not finite and for unknown words.
SceneParams with_live_values(SceneParams scene, const dynamic_reconfigure::Config& values);

}  // namespace cloth
