#pragma once

// A spring's correction in a small step of extended position-based dynamics: the formula is in xpbd.cpp.

#include "cloth_sim/model/inverse_root.h"
#include "cloth_sim/model/spring_batch.h"
#include "cloth_sim/model/spring_rows.h"

namespace cloth
{

/// What the springs of a batch have in common in a step.
template <typename Scalar>
struct Gains
{
  Scalar damping;     ///< c/(k h)
  Scalar compliance;  ///< 1/(k h^2), 1/kg
  Scalar rest_length;
};

template <typename Scalar>
Gains<Scalar> gains_of(const SpringBatch& batch, double compliance, double h)
{
  return { Scalar(compliance * batch.damping / (batch.stiffness * h)), Scalar(compliance / (batch.stiffness * h * h)),
           Scalar(batch.rest_length) };
}

/// The chosen springs' changes, from the ends' ways since the step's begin and the positions then.
template <bool fused, typename Scalar, typename IsChosen>
void find_changes(const SpringRow<Scalar>& ways, const SpringRow<Scalar>& before, const Gains<Scalar>& gains,
                  IsChosen&& is_chosen, RowChanges<Scalar>& changes)
{
  const Scalar rest_length = gains.rest_length;
  const Scalar damping = gains.damping;
  const Scalar compliance = gains.compliance;
  const Scalar* const w_i = ways.w_i;
  const Scalar* const w_j = ways.w_j;
  const Scalar* const way_x_i = ways.i[0];
  const Scalar* const way_y_i = ways.i[1];
  const Scalar* const way_z_i = ways.i[2];
  const Scalar* const way_x_j = ways.j[0];
  const Scalar* const way_y_j = ways.j[1];
  const Scalar* const way_z_j = ways.j[2];
  const Scalar* const x_i = before.i[0];
  const Scalar* const y_i = before.i[1];
  const Scalar* const z_i = before.i[2];
  const Scalar* const x_j = before.j[0];
  const Scalar* const y_j = before.j[1];
  const Scalar* const z_j = before.j[2];
  const int n = ways.n;
  const int padded = ways.padded();
#pragma GCC ivdep
  for (int k = 0; k < padded; ++k)
  {
    const Scalar way_x = way_x_j[k] - way_x_i[k];
    const Scalar way_y = way_y_j[k] - way_y_i[k];
    const Scalar way_z = way_z_j[k] - way_z_i[k];
    const Scalar x = x_j[k] - x_i[k] + way_x;
    const Scalar y = y_j[k] - y_i[k] + way_y;
    const Scalar z = z_j[k] - z_i[k] + way_z;
    const Scalar square = x * x + y * y + z * z;
    const Scalar inverse = inverse_root<fused>(square);
    const Scalar w = w_i[k] + w_j[k];
    const Scalar lengthening = inverse * (x * way_x + y * way_y + z * way_z);
    const Scalar resistance = (Scalar(1) + damping) * w + compliance;
    const Scalar lambda = (square * inverse - rest_length + damping * lengthening) / resistance;
    const Scalar part = is_chosen(k) && k < n && w > Scalar(0) ? lambda * inverse : Scalar(0);
    changes.x[k] = part * x;
    changes.y[k] = part * y;
    changes.z[k] = part * z;
  }
}

}  // namespace cloth
