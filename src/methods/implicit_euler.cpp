#include "implicit_stage.h"
#include "rows.h"

namespace cloth
{
namespace
{

/// Backward Euler: v' = v + h a(t', x', v'), x' = x + h v'.
class ImplicitEuler : public Method
{
public:
  StepReport step(const Dynamics& dynamics, double h, ClothState& state) override
  {
    StepReport report;
    start_ = state;
    state.time += h;
    stage_.solve(dynamics, state.time, h, start_.positions, start_.velocities, state.positions, state.velocities,
                 report);
    add_impulses(h, stage_.forces());
    return report;
  }

private:
  ImplicitStage stage_;
  ClothState start_;
};

}  // namespace

const MethodRow implicit_euler{ "implicit_euler",
                                1,
                                no_stability_limit,
                                { -1.0, 2 },
                                false,
                                false,
                                false,
                                2,
                                1,
                                "damps every swing, the quick ones most; very long steps may not converge",
                                make_plain<ImplicitEuler> };

}  // namespace cloth
