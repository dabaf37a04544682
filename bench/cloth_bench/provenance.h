#pragma once

#include <string>

namespace cloth
{

/// Where measurements come from.
struct Provenance
{
  std::string machine;   ///< processor, and how many of them
  std::string compiler;  ///< and how it was told to optimise
  std::string commit;    ///< of the source, with -dirty where it was changed since
};

/// Of this program on this machine. No part has a comma.
Provenance provenance_here();

/// Writes it to a file of `folder`, or holds it against the one there. Throws std::runtime_error with both where they
/// differ: figures of two machines or two programs do not belong on one chart.
void require_same_provenance(const std::string& folder, const Provenance& provenance);

}  // namespace cloth
