#include "rows.h"
#include "runge_kutta.h"

namespace cloth
{
namespace
{

/// x' = x + h v, v' = v + h a(t, x, v).
const Tableau& tableau()
{
  static const Tableau coefficients{ { 0.0 }, { {} }, { 1.0 } };
  return coefficients;
}

double stability_limit(const Mode& mode)
{
  static const StabilityRegion region(tableau());
  return region.limit(mode);
}

}  // namespace

const MethodRow explicit_euler{ "explicit_euler",
                                1,
                                stability_limit,
                                { 1.0, 2 },
                                false,
                                false,
                                false,
                                1,
                                0,
                                "every swing is wider than the last, at any step that damping does not pay for",
                                [](const MethodSettings&) -> std::unique_ptr<Method> {
                                  return std::make_unique<RungeKutta>(tableau());
                                } };

}  // namespace cloth
