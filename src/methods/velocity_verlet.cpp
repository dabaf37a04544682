#include <cmath>
#include <limits>

#include "rows.h"

namespace cloth
{
namespace
{

/// Velocity Verlet with one force evaluation a step. The springs' internal damping is taken at the predicted velocity
/// v + h a, the air implicitly, node by node; both keep the order at 2, which damping at the old velocity would not.
///
///   v_half = v + h/2 a,   x' = x + h v_half
///   v'     = v_half + h/2 (f(x', v + h a)/m + air(x', v')/m)
///   a'     = 2/h (v' - v_half), kept for the next step
class VelocityVerlet : public Method
{
public:
  StepReport step(const Dynamics& dynamics, double h, ClothState& state) override
  {
    StepReport report;
    report.force_evaluations = 1;
    if (!accelerations_known_)
    {
      dynamics.accelerations(state.time, state.positions, state.velocities, accelerations_);
      accelerations_known_ = true;
      predicted_ = state.velocities;
      ++report.force_evaluations;
    }
    if (records())
    {
      record_first_half(dynamics, h, state);
    }
    const double end = state.time + h;
    predicted_ = state.velocities + h * accelerations_;
    state.velocities += 0.5 * h * accelerations_;
    state.positions += h * state.velocities;
    dynamics.pins().impose(end, state.positions, predicted_);

    dynamics.forces_without_air(end, state.positions, predicted_, accelerations_);
    add_impulses(0.5 * h, accelerations_);
    dynamics.accelerations_of(accelerations_, accelerations_);
    half_way_ = state.velocities;
    state.velocities += 0.5 * h * accelerations_;
    dynamics.air().damp_implicitly(dynamics.model(), end, state.positions, 0.5 * h, state.velocities);
    accelerations_ = (2.0 / h) * (state.velocities - half_way_);

    dynamics.pins().clear_held(accelerations_);
    dynamics.pins().impose_velocities(end, state.velocities);
    state.time = end;
    if (records())
    {
      record_air(dynamics, 0.5 * h, state);
    }
    return report;
  }

  void restart() override
  {
    accelerations_known_ = false;
  }

private:
  /// With the springs' forces at the velocities that the kept accelerations come from.
  void record_first_half(const Dynamics& dynamics, double h, const ClothState& state)
  {
    dynamics.forces_without_air(state.time, state.positions, predicted_, forces_);
    add_impulses(0.5 * h, forces_);
    record_air(dynamics, 0.5 * h, state);
  }

  /// At the velocities that held nodes have.
  void record_air(const Dynamics& dynamics, double duration, const ClothState& state)
  {
    forces_.setZero(state.positions.rows(), 3);
    dynamics.air().add_forces(dynamics.model(), state.time, state.positions, state.velocities, forces_);
    add_impulses(duration, forces_);
  }

  bool accelerations_known_ = false;
  Vectors accelerations_;
  Vectors predicted_;
  Vectors half_way_;
  Vectors forces_;
};

// The first eigenvalue of the step to leave the unit circle leaves it at -1, where z^2/4 + D h = 1, D being the
// springs' part alone: the air, taken implicitly, does not move the limit.
double stability_limit(const Mode& mode)
{
  const double w = mode.frequency;
  const double d = mode.spring_damping;
  if (w == 0.0 && d == 0.0)
  {
    return std::numeric_limits<double>::infinity();
  }
  return 2.0 / (std::sqrt(d * d + w * w) + d);
}

}  // namespace

const MethodRow velocity_verlet{ "velocity_verlet",
                                 2,
                                 stability_limit,
                                 { 0.0, 0 },
                                 true,
                                 false,
                                 1,
                                 0,
                                 "neighbouring nodes swing against each other, every step further",
                                 make_plain<VelocityVerlet> };

}  // namespace cloth
