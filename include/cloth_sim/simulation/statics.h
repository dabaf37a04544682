#pragma once

#include <Eigen/Core>

#include "cloth_sim/constraints/pins.h"
#include "cloth_sim/model/cloth_model.h"

namespace cloth
{

/// How a search for rest ended.
struct StaticsReport
{
  bool converged = false;
  double residual = 0.0;     ///< largest net force on a free node, the limit's tensions included, over `force_scale`
  double force_scale = 0.0;  ///< N; the sheet's weight, without gravity the largest k l0 of a spring
  double excess = 0.0;       ///< largest strain of a limited spring above max_strain; 0 where none is above
  int iterations = 0;        ///< of Newton's method
  int hessian_products = 0;
};

/// Moves the free nodes of `positions` (m, one row a node) to where springs and gravity (m/s2) balance: a local minimum
/// of the energy, found by Newton's method in a trust region, its linear systems by conjugate gradients (Steihaug 1983;
/// Nocedal and Wright, "Numerical Optimization", chapter 7) with the springs' exact Hessian, which is never stored. A
/// balance from which some direction leads further down is left that way. Held nodes stay.
///
/// With `max_strain` above 0 structural and shear springs are stretched no further than that: each limited spring may
/// pull beside its elasticity, tension only, found by the augmented Lagrangian (Nocedal and Wright, chapter 17). A
/// spring between two held nodes is not limited.
///
/// The search ends where no free node feels more than `tolerance` times the force scale.
/// Not converged: there is no rest (nothing holds the sheet; the pins are too far apart for the limit), or the search
/// was given up; `positions` is where it stood.
StaticsReport settle(const ClothModel& model, const Pins& pins, const Eigen::Vector3d& gravity, double max_strain,
                     double tolerance, Vectors& positions);

/// Whether `settle` with a small tolerance would move no node of `positions` (m) by more than `distance` (m). False
/// also where it would take long to find that out.
bool is_near_rest(const ClothModel& model, const Pins& pins, const Eigen::Vector3d& gravity, double max_strain,
                  double distance, const Vectors& positions);

/// Whether springs join every node to a pin.
bool holds_every_node(const ClothModel& model, const Pins& pins);

}  // namespace cloth
