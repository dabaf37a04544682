#include <algorithm>
#include <limits>

#include "cloth_sim/methods/method.h"
#include "rows.h"

namespace cloth
{

const std::vector<MethodRow>& methods()
{
  static const std::vector<MethodRow> table{ symplectic_euler, velocity_verlet, rk4 };
  return table;
}

const MethodRow* find_method(const std::string& name)
{
  const std::vector<MethodRow>& table = methods();
  const auto found = std::find_if(table.begin(), table.end(), [&](const MethodRow& row) { return row.name == name; });
  return found == table.end() ? nullptr : &*found;
}

double network_stability_limit(const MethodRow& method, const Mode& stiffest)
{
  constexpr int parts = 32;
  double least = std::numeric_limits<double>::infinity();
  for (int p = 0; p <= parts; ++p)
  {
    const double part = static_cast<double>(p) / parts;
    const Mode mode{ stiffest.frequency, stiffest.air_damping, part * stiffest.spring_damping };
    least = std::min(least, method.stability_limit(mode));
  }
  return least;
}

}  // namespace cloth
