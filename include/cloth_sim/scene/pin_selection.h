#pragma once

#include <string>
#include <vector>

#include "cloth_sim/model/cloth_model.h"
#include "cloth_sim/scene/scene_params.h"

namespace cloth
{

/// The places that a pin's `at` may name: corners, edges, border.
const std::vector<std::string>& pin_places();

/// The nodes that a pin names, each once. `path` is the pin's key, for the fault. Throws SceneError where a node is not
/// on the sheet.
std::vector<int> nodes_of(const PinParams& pin, const ClothModel& model, const std::string& path);

/// The scene's pins, holding their nodes where `positions` (m) has them. A node that two pins name belongs to the
/// first. Throws SceneError where the two do not move alike.
std::vector<Pin> pins_of(const std::vector<PinParams>& pins, const ClothModel& model, const Vectors& positions);

}  // namespace cloth
