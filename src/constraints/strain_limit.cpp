#include "cloth_sim/constraints/strain_limit.h"

#include <algorithm>
#include <iterator>
#include <limits>

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
  inverse_masses_.resize(static_cast<size_t>(model.nodes()));
}

StrainLimit::StrainLimit(StrainLimit&&) noexcept = default;
StrainLimit& StrainLimit::operator=(StrainLimit&&) noexcept = default;
StrainLimit::~StrainLimit() = default;

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

StrainLimit::Report StrainLimit::apply(const ClothModel& model, const Pins& pins, double h, ClothState& state,
                                       Vectors* impulses)
{
  for (int i = 0; i < model.nodes(); ++i)
  {
    inverse_masses_[static_cast<size_t>(i)] = pins.holds(i) ? 0.0 : 1.0 / model.masses[i];
  }
  find_reach(model, pins, state.positions);
  const double max_strain = std::max(properties_.max_strain, reach_.strain * room_of_reach);
  uncorrected_ = state.positions;
  Vectors shifts = Vectors::Zero(impulses != nullptr ? model.nodes() : 0, 3);
  const Report report = shortening_->shorten(inverse_masses_, max_strain, properties_.sweeps, state.positions,
                                             impulses != nullptr ? &shifts : nullptr);
  if (report.moved)
  {
    state.velocities += (state.positions - uncorrected_) / h;
  }
  if (impulses != nullptr)
  {
    *impulses += shifts / h;
  }
  return report;
}

}  // namespace cloth
