#pragma once

// One mass on one spring below a pinned node, moving along the spring: linear, so that exact answers are known.

#include <cmath>

#include "support.h"

namespace cloth
{

class Oscillator
{
public:
  /// Damping ratios by the air and by the spring: D = 2 zeta omega = D_air + D_spring, 1/s.
  Oscillator(const char* method, double frequency, double air_ratio, double spring_ratio)
    : Oscillator(method, frequency, air_ratio, spring_ratio, one_step_a_call(*find_method(method)))
  {
  }

  Oscillator(const char* method, double frequency, double air_ratio, double spring_ratio,
             const MethodSettings& settings)
    : dynamics_(make_sheet(sheet(frequency, spring_ratio)), Eigen::Vector3d::Zero(),
                { air_viscosity(frequency, air_ratio), 0.0, Eigen::Vector3d::Zero(), {} })
    , method_(find_method(method)->make(settings))
  {
    const Vectors& rest = dynamics_.model().rest_positions;
    dynamics_.pins().hold(still_pin("top", { 0 }, rest));
    state_.positions = rest;
    state_.velocities = Vectors::Zero(2, 3);
  }

  void put(double displacement, double velocity)
  {
    state_.positions(1, 2) = -1.0 - displacement;
    state_.velocities(1, 2) = -velocity;
    method_->restart();
  }

  void step(double h)
  {
    method_->step(dynamics_, h, state_);
  }

  double displacement() const
  {
    return -1.0 - state_.positions(1, 2);
  }
  double velocity() const
  {
    return -state_.velocities(1, 2);
  }
  double energy(double frequency) const
  {
    return 0.5 * (velocity() * velocity() + frequency * frequency * displacement() * displacement());
  }
  const Dynamics& dynamics() const
  {
    return dynamics_;
  }

private:
  // The moving mass is 1 kg, so that k = omega^2 and c = D.
  static SheetProperties sheet(double frequency, double spring_ratio)
  {
    SheetProperties properties = chain(2, frequency * frequency, 1.0);
    properties.structural.damping = 2.0 * spring_ratio * frequency;
    return properties;
  }

  static double air_viscosity(double frequency, double air_ratio)
  {
    const double node_area = 0.5 * 0.01 * 1.0;
    return 2.0 * air_ratio * frequency / node_area;
  }

  Dynamics dynamics_;
  std::unique_ptr<Method> method_;
  ClothState state_;
};

}  // namespace cloth
