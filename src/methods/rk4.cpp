#include "rows.h"
#include "runge_kutta.h"

namespace cloth
{
namespace
{

/// The classical Runge-Kutta method.
const Tableau& tableau()
{
  static const Tableau coefficients{ { 0.0, 0.5, 0.5, 1.0 },
                                     { {}, { 0.5 }, { 0.0, 0.5 }, { 0.0, 0.0, 1.0 } },
                                     { 1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0 } };
  return coefficients;
}

double stability_limit(const Mode& mode)
{
  static const StabilityRegion region(tableau());
  return region.limit(mode);
}

}  // namespace

const MethodRow rk4{ "rk4",
                     4,
                     stability_limit,
                     { -1.0 / 72.0, 6 },
                     false,
                     false,
                     false,
                     4,
                     0,
                     "the stiffest modes grow slowly at first, then at once",
                     [](const MethodSettings&) -> std::unique_ptr<Method> {
                       return std::make_unique<RungeKutta>(tableau());
                     } };

}  // namespace cloth
