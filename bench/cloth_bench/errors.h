#pragma once

#include <vector>

#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/model/cloth_state.h"

namespace cloth
{

/// How far a motion is from the reference, over all sampled times.
struct Errors
{
  double rms = 0.0;     ///< root mean square of the nodes' distances, all nodes and times alike, m
  double worst = 0.0;   ///< the largest distance of any node at any time, m
  double energy = 0.0;  ///< the largest difference of kinetic, elastic and gravitational energy together, J. What the
                        ///< reference dissipates and takes in, the equations ask for: the rest is error
  double strain = 0.0;  ///< the largest difference of the sheet's largest strain (structural, shear)
};

Errors errors_of(const Dynamics& dynamics, const std::vector<ClothState>& samples,
                 const std::vector<ClothState>& reference);

/// The first of these alone.
double rms_distance(const std::vector<ClothState>& samples, const std::vector<ClothState>& reference);

}  // namespace cloth
