#include "cloth_sim/model/part_calls.h"

namespace cloth
{

const char* name_of(Part part)
{
  constexpr std::array<const char*, number_of_parts> names{ "structural_springs",
                                                            "shear_springs",
                                                            "flex_springs",
                                                            "internal_damping",
                                                            "gravity",
                                                            "viscous_damping",
                                                            "wind",
                                                            "normals",
                                                            "strain_limit",
                                                            "strain_watch",
                                                            "pins",
                                                            "pin_motions" };
  return names[static_cast<std::size_t>(part)];
}

Part springs_of(SpringKind kind)
{
  switch (kind)
  {
    case SpringKind::structural:
      return Part::structural_springs;
    case SpringKind::shear:
      return Part::shear_springs;
    default:
      return Part::flex_springs;
  }
}

void PartCalls::add_difference(const PartCalls& before, const PartCalls& after)
{
  for (std::size_t part = 0; part < number_of_parts; ++part)
  {
    counts[part] += after.counts[part] - before.counts[part];
  }
}

PartCalls& part_calls()
{
  thread_local PartCalls calls;
  return calls;
}

void count_call(const SpringBatch& batch)
{
  ++part_calls()[springs_of(batch.kind)];
}

}  // namespace cloth
