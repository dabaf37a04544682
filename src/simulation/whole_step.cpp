#include "whole_step.h"

namespace cloth
{

StepReport take_whole_step(Method& method, StrainLimit& limit, const Dynamics& dynamics, double h, ClothState& state,
                           Vectors* impulses)
{
  const double begin = state.time;
  const ClothModel& model = dynamics.model();
  const bool has_tensions = limit.active() && limit.properties().solver == LimitSolver::tensions;
  const double max_strain = has_tensions ? limit.max_strain_for(model, dynamics.pins(), state.positions) : 0.0;
  const bool is_kept_by_method = method.limit_strain(max_strain, limit.properties().sweeps) && has_tensions;
  StepReport report = method.step(dynamics, h, state);
  if (limit.active() && !is_kept_by_method)
  {
    const StrainLimit::Report limited = limit.apply(model, dynamics.pins(), state.time - begin, state, impulses);
    if (limited.moved)
    {
      method.restart();
    }
    report.limit_sweeps += limited.sweeps;
  }
  return report;
}

}  // namespace cloth
