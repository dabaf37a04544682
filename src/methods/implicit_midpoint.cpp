#include "implicit_stage.h"
#include "rows.h"

namespace cloth
{
namespace
{

/// Half a step of backward Euler to the middle, and as far again:
/// v_m = v + h/2 a(t + h/2, x_m, v_m), x_m = x + h/2 v_m; then x' = 2 x_m - x, v' = 2 v_m - v.
class ImplicitMidpoint : public Method
{
public:
  StepReport step(const Dynamics& dynamics, double h, ClothState& state) override
  {
    StepReport report;
    start_ = state;
    stage_.solve(dynamics, state.time + 0.5 * h, 0.5 * h, start_.positions, start_.velocities, state.positions,
                 state.velocities, report);
    add_impulses(h, stage_.forces());
    state.positions = 2.0 * state.positions - start_.positions;
    state.velocities = 2.0 * state.velocities - start_.velocities;
    state.time += h;
    dynamics.pins().impose(state.time, state.positions, state.velocities);
    return report;
  }

private:
  ImplicitStage stage_;
  ClothState start_;
};

}  // namespace

const MethodRow implicit_midpoint{ "implicit_midpoint",
                                   2,
                                   no_stability_limit,
                                   { 0.0, 0 },
                                   true,
                                   false,
                                   false,
                                   2,
                                   1,
                                   "stiff swings are kept and slowed down; under stretch long steps grow",
                                   make_plain<ImplicitMidpoint> };

}  // namespace cloth
