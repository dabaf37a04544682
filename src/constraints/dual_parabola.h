#pragma once

#include <algorithm>

#include "cloth_sim/model/spring_rows.h"

namespace cloth
{

/// How good the tensions of the last step are for this one. The dual objective, sum of p . l - |p| l_max less half the
/// sum of m |shift|^2, is 0 without tensions; along those of the last step it is rise t - curvature t^2/2, and highest
/// where they are multiplied by t = rise/curvature. Summed up lane by lane.
template <typename Scalar>
struct DualParabola
{
  alignas(64) Scalar rise[spring_row_size] = {};
  alignas(64) Scalar curvature[spring_row_size] = {};

  /// Of a spring, over that of its ends' masses: tensions that shift nothing, because they hold each other or pull on
  /// pins alone, would be multiplied for ever were springs not thought to give way a little at this point.
  static constexpr double compliance = 1e-4;

  /// By what tensions are best multiplied, at most `most`; 0 where they are of no use.
  double best_factor(double most) const
  {
    double rises = 0.0;
    double curvatures = 0.0;
    for (int k = 0; k < spring_row_size; ++k)
    {
      rises += double(rise[k]);
      curvatures += double(curvature[k]);
    }
    return rises > 0.0 && curvatures > 0.0 ? std::min(rises / curvatures, most) : 0.0;
  }
};

}  // namespace cloth
