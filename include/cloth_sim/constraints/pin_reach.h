#pragma once

#include <string>

#include "cloth_sim/constraints/pins.h"
#include "cloth_sim/model/cloth_model.h"

namespace cloth
{

/// Two pins that are as far apart as no others are, for the springs between them.
struct PinReach
{
  double strain = 0.0;  ///< of the shortest way along springs from one to the other, were it straight; 0: none is drawn
  std::string first;    ///< the pins' names, empty where no two are drawn apart
  std::string second;
};

/// The strain that pins demand of the sheet between them: the largest |x_a - x_b|/L_ab - 1 of two nodes held by
/// different pins, L_ab being the length at rest of the shortest way from one to the other along structural and shear
/// springs. No strain limit below it can be kept. Positions in m, one row a node. Looks at all pairs of such nodes.
PinReach reach_of(const ClothModel& model, const Pins& pins, const Vectors& positions);

}  // namespace cloth
