#include "spring_ways.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace cloth
{

bool has_springs(const ClothModel& model, SpringKind kind)
{
  return std::any_of(model.springs.begin(), model.springs.end(),
                     [kind](const SpringBatch& batch) { return batch.kind == kind; });
}

SpringWays::SpringWays(const ClothModel& model)
  : cols_(model.cols)
  , across_(model.cols > 1 ? model.width / (model.cols - 1) : 0.0)
  , down_(model.rows > 1 ? model.height / (model.rows - 1) : 0.0)
  , diagonal_(has_springs(model, SpringKind::shear) ? std::hypot(across_, down_) : across_ + down_)
{
}

double SpringWays::between(int a, int b) const
{
  const int columns = std::abs(a % cols_ - b % cols_);
  const int rows = std::abs(a / cols_ - b / cols_);
  const int diagonals = std::min(columns, rows);
  return diagonals * diagonal_ + (columns - diagonals) * across_ + (rows - diagonals) * down_;
}

}  // namespace cloth
