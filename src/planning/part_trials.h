#pragma once

#include <string>
#include <vector>

#include "model_parts.h"
#include "trials.h"

namespace cloth
{

/// What a trial said of a part of the model.
struct TriedPart
{
  std::string part;
  double change;  ///< of the answer without it, m; at least, where a part of it is enough to keep the part
};

struct LeftOut
{
  PartList parts;
  double change = 0.0;  ///< of the answer without all of them, m
};

/// What may be left out: what changes the answer by less than a quarter of the tolerance where all that changes it less
/// is left out already, as long as it is less than a half together. Nothing, where `allows_any` is false. `tried`
/// becomes what was found of each part, those that change it least first.
LeftOut parts_to_leave_out(Trials& trials, const Probe& probe, bool allows_any, std::vector<TriedPart>& tried);

/// Whether there is time for as many runs of the scout as parts may take.
bool can_afford_scouts(const Trials& trials);

/// The scout's longest steps.
Probe scouts(const Trials& trials);

}  // namespace cloth
