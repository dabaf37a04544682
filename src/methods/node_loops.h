#pragma once

#include "cloth_sim/model/node_range.h"
#include "cloth_sim/model/vectors.h"
#include "cloth_sim/model/wide_vectors.h"

namespace cloth
{

/// sums += factor * added, of some nodes. `sums` and `added` must not be the same.
inline void add_scaled(NodeRange nodes, double factor, const Vectors& added, Vectors& sums)
{
  in_widest_vectors([nodes, factor, &added, &sums](auto) {
    for (int d = 0; d < 3; ++d)
    {
      const double* const from = added.col(d).data();
      double* const to = sums.col(d).data();
#pragma GCC ivdep
      for (int i = nodes.begin; i < nodes.end; ++i)
      {
        to[i] += factor * from[i];
      }
    }
  });
}

}  // namespace cloth
