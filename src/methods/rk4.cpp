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

}  // namespace

const MethodRow rk4{ "rk4",
                     4,
                     [](const Mode& mode) { return stability_limit(tableau(), mode); },
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
