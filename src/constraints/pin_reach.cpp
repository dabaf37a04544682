#include "cloth_sim/constraints/pin_reach.h"

#include <iterator>

#include "spring_ways.h"

namespace cloth
{
PinReach reach_of(const ClothModel& model, const Pins& pins, const Vectors& positions)
{
  PinReach reach;
  if (!has_springs(model, SpringKind::structural))
  {
    return reach;
  }
  const SpringWays ways(model);
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
