#pragma once

#include <array>

#include "bench_scene.h"
#include "errors.h"
#include "problem.h"

namespace cloth
{

/// The same sheet with every cell cut into factor x factor. Pins that are given by nodes hold the nodes that are at the
/// same places. Spring stiffnesses stay: those of structural and shear springs are the sheet's own, whatever the grid.
SceneParams refined(SceneParams scene, int factor);

/// How far the nodes of a coarse grid are from those of a grid `factor` times as fine that are at the same places of
/// the sheet: rms and worst; energy and strain are not a number, as those of two grids are not the same.
Errors errors_between_grids(const ClothModel& coarse_model, const std::vector<ClothState>& coarse,
                            const ClothModel& fine_model, const std::vector<ClothState>& fine, int factor);

}  // namespace cloth
