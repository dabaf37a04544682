#include <cmath>

#include "implicit_stage.h"
#include "rows.h"

namespace cloth
{
namespace
{

/// The trapezoidal rule to t + gamma h, gamma = 2 - sqrt(2), then the backward difference formula of order 2 through
/// both points (Bank et al. 1985; Hosea and Shampine, "Analysis and implementation of TR-BDF2", 1996). Both stages have
/// the same factor gamma/2 before the slope at their end.
class TrBdf2 : public Method
{
public:
  StepReport step(const Dynamics& dynamics, double h, ClothState& state) override
  {
    StepReport report;
    const double s = 0.5 * gamma * h;
    if (!accelerations_known_)
    {
      dynamics.accelerations(state.time, state.positions, state.velocities, accelerations_);
      accelerations_known_ = true;
      ++report.force_evaluations;
    }
    if (records())
    {
      dynamics.forces(state.time, state.positions, state.velocities, forces_);
      add_impulses(from_middle * s, forces_);
    }
    start_ = state;
    base_positions_ = start_.positions + s * start_.velocities;
    base_velocities_ = start_.velocities + s * accelerations_;
    stage_.solve(dynamics, start_.time + gamma * h, s, base_positions_, base_velocities_, state.positions,
                 state.velocities, report);
    add_impulses(from_middle * s, stage_.forces());

    base_positions_ = from_middle * state.positions - from_start * start_.positions;
    base_velocities_ = from_middle * state.velocities - from_start * start_.velocities;
    state.time = start_.time + h;
    stage_.solve(dynamics, state.time, s, base_positions_, base_velocities_, state.positions, state.velocities, report);
    add_impulses(s, stage_.forces());
    accelerations_ = (state.velocities - base_velocities_) / s;
    dynamics.pins().clear_held(accelerations_);
    return report;
  }

  void restart() override
  {
    accelerations_known_ = false;
  }

private:
  static constexpr double gamma = 0.58578643762690495;  // 2 - sqrt(2)
  static constexpr double from_middle = 1.0 / (gamma * (2.0 - gamma));
  static constexpr double from_start = from_middle - 1.0;

  ImplicitStage stage_;
  bool accelerations_known_ = false;
  ClothState start_;
  Vectors accelerations_;
  Vectors base_positions_;
  Vectors base_velocities_;
  Vectors forces_;
};

}  // namespace

const MethodRow tr_bdf2{ "tr_bdf2",
                         2,
                         no_stability_limit,
                         { -0.0074, 4 },
                         false,
                         false,
                         false,
                         4,
                         2,
                         "damps swings that are quick for its step; very long steps may not converge",
                         make_plain<TrBdf2> };

}  // namespace cloth
