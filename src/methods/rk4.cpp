#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "rows.h"

namespace cloth
{
namespace
{

/// The classical Runge-Kutta method of order 4 for (x, v)' = (v, a(t, x, v)). Pins are imposed on every stage.
class RungeKutta4 : public Method
{
public:
  StepCost step(const Dynamics& dynamics, double h, ClothState& state) override
  {
    start_ = state;
    next_ = state;
    stage_ = state;
    take_slope(dynamics, h / 6.0, 0.5 * h);
    take_slope(dynamics, h / 3.0, 0.5 * h);
    take_slope(dynamics, h / 3.0, h);
    take_slope(dynamics, h / 6.0, h);
    state.positions.swap(next_.positions);
    state.velocities.swap(next_.velocities);
    state.time += h;
    dynamics.pins().impose(state.time, state.positions, state.velocities);
    return { 4, 0 };
  }

private:
  /// Adds `weight` times the slope at the stage to the result, and moves the stage to `ahead` from the start along it.
  void take_slope(const Dynamics& dynamics, double weight, double ahead)
  {
    dynamics.accelerations(stage_.time, stage_.positions, stage_.velocities, accelerations_);
    next_.positions += weight * stage_.velocities;
    next_.velocities += weight * accelerations_;
    stage_.positions = start_.positions + ahead * stage_.velocities;
    stage_.velocities = start_.velocities + ahead * accelerations_;
    stage_.time = start_.time + ahead;
    dynamics.pins().impose(stage_.time, stage_.positions, stage_.velocities);
  }

  ClothState start_;
  ClothState stage_;
  ClothState next_;
  Vectors accelerations_;
};

double amplification(const std::complex<double>& z)
{
  return std::abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))));
}

/// The largest s for which s * eigenvalue lies in the region |1 + z + z^2/2 + z^3/6 + z^4/24| <= 1, that of a
/// direction with Re <= 0. The region is left once: from just outside |z| = 0 it is found by bisection between the
/// half disc of radius 2.6 that it contains and the disc of radius 3 that contains it.
double limit_along(const std::complex<double>& eigenvalue)
{
  const double size = std::abs(eigenvalue);
  double inside = 2.6 / size;
  double outside = 3.0 / size;
  for (int i = 0; i < 60; ++i)
  {
    const double middle = 0.5 * (inside + outside);
    (amplification(middle * eigenvalue) <= 1.0 ? inside : outside) = middle;
  }
  return inside;
}

double stability_limit(const Mode& mode)
{
  const double w = mode.frequency;
  const double d = mode.air_damping + mode.spring_damping;
  if (w == 0.0 && d == 0.0)
  {
    return std::numeric_limits<double>::infinity();
  }
  const std::complex<double> root = std::sqrt(std::complex<double>(0.25 * d * d - w * w));
  return limit_along(-0.5 * d - root);
}

}  // namespace

const MethodRow rk4{ "rk4", 4, stability_limit, false, 4, "the stiffest modes grow slowly at first, then at once", [] {
                      return std::unique_ptr<Method>(new RungeKutta4);
                    } };

}  // namespace cloth
