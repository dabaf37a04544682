#include <cmath>
#include <limits>

#include "cloth_sim/model/wide_vectors.h"
#include "rows.h"

namespace cloth
{
namespace
{

/// Velocity Verlet with one force evaluation a step. The springs' internal damping is taken at the predicted velocity
/// v + h a, the air implicitly, node by node; both keep the order at 2, which damping at the old velocity would not.
///
///   v_half = v + h/2 a,   x' = x + h v_half
///   a'     = f(x', v + h a)/m + air(x', v')/m, kept for the next step
///   v'     = v_half + h/2 a'
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
    dynamics.for_each_band([&](NodeRange nodes) { predict_and_drift(nodes, h, state); });
    dynamics.pins().impose(end, state.positions, predicted_);
    const auto accelerate = [&](NodeRange nodes) {
      dynamics.air().accelerate_implicitly(dynamics.model(), end, state.positions, 0.5 * h, nodes, accelerations_,
                                           state.velocities);
    };
    if (records())
    {
      dynamics.forces_without_air(end, state.positions, predicted_, accelerations_);
      add_impulses(0.5 * h, accelerations_);
      dynamics.for_each_band(accelerate);
    }
    else
    {
      dynamics.for_each_band([&](NodeRange band) {
        dynamics.forces_without_air(end, state.positions, predicted_, band, accelerations_, accelerate);
      });
    }
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
  void predict_and_drift(NodeRange nodes, double h, ClothState& state)
  {
    in_widest_vectors([this, nodes, h, &state](auto) {
      for (int d = 0; d < 3; ++d)
      {
        const double* const a = accelerations_.col(d).data();
        double* const x = state.positions.col(d).data();
        double* const v = state.velocities.col(d).data();
        double* const predicted = predicted_.col(d).data();
#pragma GCC ivdep
        for (int i = nodes.begin; i < nodes.end; ++i)
        {
          const double half_way = v[i] + 0.5 * h * a[i];
          predicted[i] = v[i] + h * a[i];
          v[i] = half_way;
          x[i] += h * half_way;
        }
      }
    });
  }

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
                                 false,
                                 1,
                                 0,
                                 "neighbouring nodes swing against each other, every step further",
                                 make_plain<VelocityVerlet> };

}  // namespace cloth
