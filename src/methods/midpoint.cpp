#include "rows.h"
#include "runge_kutta.h"

namespace cloth
{
namespace
{

/// The explicit midpoint rule, Runge's of order 2: half a step of explicit Euler, then the whole step along the slope
/// found there.
const Tableau& tableau()
{
  static const Tableau coefficients{ { 0.0, 0.5 }, { {}, { 0.5 } }, { 0.0, 1.0 } };
  return coefficients;
}

double stability_limit(const Mode& mode)
{
  static const StabilityRegion region(tableau());
  return region.limit(mode);
}

}  // namespace

const MethodRow midpoint{ "midpoint",
                          2,
                          stability_limit,
                          { 0.25, 4 },
                          false,
                          false,
                          false,
                          2,
                          0,
                          "undamped swings grow slowly, at any step",
                          [](const MethodSettings&) -> std::unique_ptr<Method> {
                            return std::make_unique<RungeKutta>(tableau());
                          } };

}  // namespace cloth
