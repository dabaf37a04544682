#pragma once

// A spring's correction in a small step of extended position-based dynamics: the formula is in xpbd.cpp.

#include "cloth_sim/model/inverse_root.h"
#include "cloth_sim/model/spring_batch.h"

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

/// What lambda is divided by, for a spring whose ends' inverse masses sum to w.
template <typename Scalar>
Scalar resistance(const Gains<Scalar>& gains, Scalar w)
{
  return (Scalar(1) + gains.damping) * w + gains.compliance;
}

/// lambda times the resistance over |l|, from the square of |l| and the scalar product of l and what it has changed by
/// since the step's begin.
template <bool fused, typename Scalar>
Scalar correction(Scalar square, Scalar product, Scalar rest_length, Scalar damping)
{
  const Scalar inverse = inverse_root<fused>(square);
  return (square * inverse - rest_length + damping * (inverse * product)) * inverse;
}

/// Of a spring without damping.
template <bool fused, typename Scalar>
Scalar correction(Scalar square, Scalar rest_length)
{
  return Scalar(1) - rest_length * inverse_root<fused>(square);
}

}  // namespace cloth
