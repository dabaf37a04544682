#include <cmath>
#include <limits>

#include "node_loops.h"
#include "rows.h"

namespace cloth
{
namespace
{

/// Semi-implicit Euler: v' = v + h a(t, x, v), then x' = x + h v'. Provot (1995) steps his sheets this way.
class SymplecticEuler : public Method
{
public:
  StepReport step(const Dynamics& dynamics, double h, ClothState& state) override
  {
    dynamics.forces(state.time, state.positions, state.velocities, accelerations_);
    add_impulses(h, accelerations_);
    dynamics.for_each_band([&](NodeRange nodes) { dynamics.divide_by_masses(nodes, accelerations_); });
    dynamics.pins().clear_held(accelerations_);
    dynamics.for_each_band([&](NodeRange nodes) {
      add_scaled(nodes, h, accelerations_, state.velocities);
      add_scaled(nodes, h, state.velocities, state.positions);
    });
    state.time += h;
    dynamics.pins().impose(state.time, state.positions, state.velocities);
    StepReport report;
    report.force_evaluations = 1;
    return report;
  }

private:
  Vectors accelerations_;
};

// The first eigenvalue of the step to leave the unit circle leaves it at -1, where z^2/4 + D h/2 = 1.
double stability_limit(const Mode& mode)
{
  const double w = mode.frequency;
  const double d = mode.air_damping + mode.spring_damping;
  if (w == 0.0 && d == 0.0)
  {
    return std::numeric_limits<double>::infinity();
  }
  return 4.0 / (std::sqrt(d * d + 4.0 * w * w) + d);
}

}  // namespace

const MethodRow symplectic_euler{ "symplectic_euler",
                                  1,
                                  stability_limit,
                                  { 0.0, 0 },
                                  true,
                                  false,
                                  false,
                                  1,
                                  0,
                                  "neighbouring nodes swing against each other, every step further",
                                  make_plain<SymplecticEuler> };

}  // namespace cloth
