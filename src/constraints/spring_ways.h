#pragma once

#include "cloth_sim/model/cloth_model.h"

namespace cloth
{

bool has_springs(const ClothModel& model, SpringKind kind);

/// The shortest ways along structural and shear springs of a sheet that has structural ones; they go diagonally as far
/// as they can.
class SpringWays
{
public:
  explicit SpringWays(const ClothModel& model);

  /// The length at rest of the way from one node to another, m.
  double between(int a, int b) const;

private:
  int cols_;
  double across_;
  double down_;
  double diagonal_;
};

}  // namespace cloth
