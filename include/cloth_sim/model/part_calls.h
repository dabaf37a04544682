#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "cloth_sim/model/spring_batch.h"

namespace cloth
{

/// What a step is made of. In this order in reports.
enum class Part
{
  structural_springs,
  shear_springs,
  flex_springs,
  internal_damping,
  gravity,
  viscous_damping,
  wind,
  normals,
  strain_limit,  ///< passes that shorten springs
  strain_watch,  ///< looks at the springs' lengths, after which there may be no pass
  pins,
  pin_motions  ///< where a pin is on its way, worked out
};

constexpr std::size_t number_of_parts = static_cast<std::size_t>(Part::pin_motions) + 1;

/// The name of enumerator number `part` above.
const char* name_of(Part part);
Part springs_of(SpringKind kind);

/// How often the code of each part was called: once for the whole sheet, or for a batch of springs, however many
/// springs and nodes it has and threads share it.
struct PartCalls
{
  std::array<std::uint64_t, number_of_parts> counts{};

  std::uint64_t& operator[](Part part)
  {
    return counts[static_cast<std::size_t>(part)];
  }
  std::uint64_t operator[](Part part) const
  {
    return counts[static_cast<std::size_t>(part)];
  }
  /// Adds what was counted between two moments.
  void add_difference(const PartCalls& before, const PartCalls& after);
};

/// What this thread has called since it began. The code of the parts counts here itself, where it does node 0;
/// Dynamics::for_each_band hands on to the thread that called it what another did.
PartCalls& part_calls();

/// One call of the batch's springs, whether for their forces or for what follows from those.
void count_call(const SpringBatch& batch);

}  // namespace cloth
