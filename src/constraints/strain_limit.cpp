#include "cloth_sim/constraints/strain_limit.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "cloth_sim/model/spring_rows.h"

#include "plain_sweeps.h"
#include "shortening.h"
#include "spring_tensions.h"

namespace cloth
{
namespace
{

std::unique_ptr<Shortening> make_shortening(const ClothModel& model, const StrainLimitProperties& properties)
{
  if (properties.max_strain == 0.0)
  {
    return nullptr;
  }
  if (properties.solver == LimitSolver::plain_sweeps)
  {
    return std::make_unique<PlainSweeps>(model);
  }
  return std::make_unique<SpringTensions>(model);
}

}  // namespace

std::vector<SpringBatch> limited_batches(const ClothModel& model)
{
  std::vector<SpringBatch> limited;
  std::copy_if(model.springs.begin(), model.springs.end(), std::back_inserter(limited),
               [](const SpringBatch& batch) { return batch.kind != SpringKind::flex; });
  return limited;
}

StrainLimit::StrainLimit(const ClothModel& model, const StrainLimitProperties& properties)
  : properties_(properties), shortening_(make_shortening(model, properties))
{
  inverse_masses_.setZero(model.nodes() + row_padding);
  corrected_.setZero(model.nodes() + row_padding, 3);
}

StrainLimit::StrainLimit(StrainLimit&&) noexcept = default;
StrainLimit& StrainLimit::operator=(StrainLimit&&) noexcept = default;
StrainLimit::~StrainLimit() = default;

void StrainLimit::go_on_from(const StrainLimit& before)
{
  if (active() && before.active())
  {
    shortening_->go_on_from(*before.shortening_);
  }
}

double StrainLimit::strain_in_force() const
{
  return std::max(properties_.max_strain, reach_.strain * room_of_reach);
}

double StrainLimit::held_strain() const
{
  const double margin = properties_.solver == LimitSolver::tensions ? least_margin : 0.0;
  return active() ? (1.0 - margin) * strain_in_force() : 0.0;
}

/// Looks again only after pins have moved.
void StrainLimit::find_reach(const ClothModel& model, const Pins& pins, const Vectors& positions)
{
  std::vector<double> held;
  for (const Pin& pin : pins.all())
  {
    held.push_back(std::numeric_limits<double>::infinity());
    for (const int node : pin.nodes)
    {
      held.insert(held.end(),
                  { static_cast<double>(node), positions(node, 0), positions(node, 1), positions(node, 2) });
    }
  }
  if (held != held_)
  {
    held_.swap(held);
    reach_ = reach_of(model, pins, positions);
  }
}

double StrainLimit::max_strain_for(const ClothModel& model, const Pins& pins, const Vectors& positions)
{
  find_reach(model, pins, positions);
  return strain_in_force();
}

StrainLimit::Report StrainLimit::apply(const ClothModel& model, const Pins& pins, double h, ClothState& state,
                                       Vectors* impulses)
{
  pins.find_inverse_masses(model.masses, inverse_masses_);
  find_reach(model, pins, state.positions);
  corrected_.topRows(model.nodes()) = state.positions;
  Vectors shifts = Vectors::Zero(impulses != nullptr ? model.nodes() : 0, 3);
  const Report report = shortening_->shorten(inverse_masses_, strain_in_force(), properties_.sweeps, h, corrected_,
                                             impulses != nullptr ? &shifts : nullptr);
  if (report.moved)
  {
    state.velocities += (corrected_.topRows(model.nodes()) - state.positions) / h;
    state.positions = corrected_.topRows(model.nodes());
  }
  if (impulses != nullptr)
  {
    *impulses += shifts / h;
  }
  return report;
}

}  // namespace cloth
