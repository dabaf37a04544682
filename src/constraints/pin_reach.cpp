#include "cloth_sim/constraints/pin_reach.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace cloth
{
namespace
{

bool has_springs(const ClothModel& model, SpringKind kind)
{
  return std::any_of(model.springs.begin(), model.springs.end(),
                     [kind](const SpringBatch& batch) { return batch.kind == kind; });
}

/// The shortest ways along springs, which go diagonally as far as they can.
class Ways
{
public:
  explicit Ways(const ClothModel& model)
    : model_(model)
    , across_(model.cols > 1 ? model.width / (model.cols - 1) : 0.0)
    , down_(model.rows > 1 ? model.height / (model.rows - 1) : 0.0)
    , diagonal_(has_springs(model, SpringKind::shear) ? std::hypot(across_, down_) : across_ + down_)
  {
  }

  double between(int a, int b) const
  {
    const int columns = std::abs(model_.col_of(a) - model_.col_of(b));
    const int rows = std::abs(model_.row_of(a) - model_.row_of(b));
    const int diagonals = std::min(columns, rows);
    return diagonals * diagonal_ + (columns - diagonals) * across_ + (rows - diagonals) * down_;
  }

private:
  const ClothModel& model_;
  double across_;
  double down_;
  double diagonal_;
};

}  // namespace

PinReach reach_of(const ClothModel& model, const Pins& pins, const Vectors& positions)
{
  PinReach reach;
  if (!has_springs(model, SpringKind::structural))
  {
    return reach;
  }
  const Ways ways(model);
  for (auto first = pins.all().begin(); first != pins.all().end(); ++first)
  {
    for (auto second = std::next(first); second != pins.all().end(); ++second)
    {
      for (const int a : first->nodes)
      {
        for (const int b : second->nodes)
        {
          const double strain = (positions.row(a) - positions.row(b)).norm() / ways.between(a, b) - 1.0;
          if (strain > reach.strain)
          {
            reach = { strain, first->name, second->name };
          }
        }
      }
    }
  }
  return reach;
}

}  // namespace cloth
