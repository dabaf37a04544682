#pragma once

#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/methods/method.h"

namespace cloth
{

/// What is known of the modes of a network, linearised about some positions with pinned nodes at rest: each has a
/// frequency omega up to `frequency`, is damped by the air at a rate between the two given ones, and by its springs at
///
///   damping_ratio (omega^2 - undamped_frequency^2)  <=  D  <=  damping_ratio omega^2,   D <= most_spring_damping
///
/// since C = damping_ratio (K - K_u), K_u being what internal damping does not reach: the stiffness across stretched
/// springs, and that of springs which are less damped than others.
struct Spectrum
{
  double frequency = 0.0;            ///< rad/s
  double undamped_frequency = 0.0;   ///< rad/s; a bound that holds
  double damping_ratio = 0.0;        ///< the largest c/k of all springs, s
  double most_spring_damping = 0.0;  ///< 1/s
  double least_air_damping = 0.0;    ///< C_dis/m, 1/s
  double most_air_damping = 0.0;     ///< (C_dis + C_vi)/m, 1/s
};

/// Bounds for the modes of a network.
struct SpectrumBounds
{
  double stiffness = 0.0;  ///< for omega^2, the largest eigenvalue of M^-1 K, 1/s2
  double damping = 0.0;    ///< for D, the largest eigenvalue of M^-1 C, 1/s
  /// What each node's springs have to do with them: the largest is the bound. Empty where D's is damping_ratio omega^2.
  Eigen::VectorXd node_stiffness;
  Eigen::VectorXd node_damping;
};

/// Bounds that hold, from the springs at each node (`block_bounds`); for D where internal damping matters to explicit
/// steps, or else damping_ratio omega^2. Exact for omega^2 inside a flat uniform sheet, up to 1.5 times too large on
/// shipped scenes.
SpectrumBounds spectrum_bounds(const Dynamics& dynamics, const Vectors& positions);

/// The spectrum about `positions` (m). Springs under compression count without their destabilising part (see
/// `add_stiffness_product`).
///
/// omega^2 comes from the Lanczos form of the power iteration, started from a vector of noise. Its Ritz value is never
/// above the eigenvalue; with the residual added it is a bound that is hardly ever missed (Zhou and Li, "Bounding the
/// spectrum of large Hermitian matrices", 2011), and 1 % is added for the rest. Where the bound of `spectrum_bounds` is
/// lower, that is taken. D is found likewise where it is above 0.2 omega; below, steps would hardly be longer for it.
Spectrum spectrum_of(const Dynamics& dynamics, const Vectors& positions);

/// The same from bounds alone.
Spectrum spectrum_of(const Dynamics& dynamics, const Vectors& positions, const SpectrumBounds& bounds);

/// Bounds for the network in whatever shape, however its springs are stretched: no spring is stiffer than k in any
/// direction, so that omega^2 is at most twice the stiffness of a node's springs over its mass. In a flat sheet that is
/// up to twice what it is.
Spectrum spectrum_of_any_shape(const Dynamics& dynamics);

/// The largest step that is stable for every mode that a network of this spectrum can have, s.
double network_stability_limit(const MethodRow& method, const Spectrum& spectrum);

/// The largest step that is stable for the fastest modes alone, s: never smaller than that, most often the same, and
/// found in a hundredth of the time.
double likely_limit(const MethodRow& method, const Spectrum& spectrum);

}  // namespace cloth
