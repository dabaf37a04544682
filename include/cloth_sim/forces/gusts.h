#pragma once

#include <array>

#include <Eigen/Core>

namespace cloth
{

struct GustProperties
{
  double strength = 0.0;    ///< root mean square of each component, m/s; 0: none
  double time_scale = 1.0;  ///< s
  int seed = 1;             ///< not negative; the same seed is the same wind
};

/// A wind that changes smoothly with time and is the same all over the sheet: in each direction, independently,
///
///   strength sqrt(2/n) sum_k sin(omega_k t + phase_k),   k = 0 ... n-1
///
/// (Shinozuka and Deodatis, "Simulation of stochastic processes by spectral representation", 1991). The frequencies
/// share out the spectrum of Dryden's gusts along the wind, which falls off as 1/(1 + (omega time_scale)^2), into parts
/// of equal power, one wave each: omega_k = tan(pi/2 (k + u_k)/(n + 1))/time_scale. The seed draws the phases, and u_k
/// in [0, 1), from a third of its own in each direction, so that no two waves are alike. Over a long time the mean
/// square is strength^2, directions are independent, and a moment and another, t later, agree about as
/// exp(-t/time_scale). Nothing changes faster than omega = 2 (n + 1)/(pi time_scale).
class Gusts
{
public:
  static constexpr int waves = 16;  ///< n

  explicit Gusts(const GustProperties& properties);

  /// m/s; zero at any time where the strength is 0.
  Eigen::Vector3d at(double time) const;
  /// No gust is ever faster, m/s.
  double top_speed() const;

private:
  struct Wave
  {
    double frequency = 0.0;  ///< rad/s
    double phase = 0.0;      ///< rad
  };

  double amplitude_;                                ///< of a wave, m/s
  std::array<std::array<Wave, waves>, 3> waves_{};  ///< of each direction
};

}  // namespace cloth
