#include <algorithm>
#include <limits>

#include "cloth_sim/methods/method.h"
#include "rows.h"

namespace cloth
{

const std::vector<MethodRow>& methods()
{
  static const std::vector<MethodRow> table{
    explicit_euler, symplectic_euler,  velocity_verlet, midpoint,   rk4, dopri5,
    implicit_euler, implicit_midpoint, tr_bdf2,         projective, xpbd
  };
  return table;
}

const MethodRow* find_method(const std::string& name)
{
  const std::vector<MethodRow>& table = methods();
  const auto found = std::find_if(table.begin(), table.end(), [&](const MethodRow& row) { return row.name == name; });
  return found == table.end() ? nullptr : &*found;
}

double no_stability_limit(const Mode& /*mode*/)
{
  return std::numeric_limits<double>::infinity();
}

}  // namespace cloth
