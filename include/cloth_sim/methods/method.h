#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/model/cloth_state.h"

namespace cloth
{

/// What a step cost.
struct StepCost
{
  int force_evaluations = 0;
  int linear_solves = 0;
};

/// A time-stepping method at work on one cloth.
class Method
{
public:
  virtual ~Method() = default;

  /// Advances `state` by h seconds, pins included.
  virtual StepCost step(const Dynamics& dynamics, double h, ClothState& state) = 0;

  /// Forgets what was kept from the last step. To be called whenever something other than the method changed the
  /// state, the pins or the forces.
  virtual void restart()
  {
  }
};

/// One mode of a linearised network, x'' = -frequency^2 x - (air_damping + spring_damping) x'.
struct Mode
{
  double frequency = 0.0;       ///< omega, rad/s
  double air_damping = 0.0;     ///< C/m of the air, 1/s
  double spring_damping = 0.0;  ///< c/m of internal damping, 1/s
};

/// A row of the table of methods: what it is called, promises and costs.
struct MethodRow
{
  const char* name;                             ///< in scene files; also the name of its source file
  int order;                                    ///< of the error in positions and velocities
  double (*stability_limit)(const Mode& mode);  ///< largest stable step, s; infinite where there is none
  bool conserves_angular_momentum;              ///< exactly, of a free undamped network (linear momentum: all do)
  int force_evaluations;                        ///< a step
  const char* failure;                          ///< what is seen beyond the stability limit
  std::unique_ptr<Method> (*make)();
};

/// All methods that are built.
const std::vector<MethodRow>& methods();

/// The row of that name, or null.
const MethodRow* find_method(const std::string& name);

/// The largest step that is stable for a network whose stiffest mode is `stiffest` and whose other modes may be
/// damped by any part of its rates: the least limit over them, s.
double network_stability_limit(const MethodRow& method, const Mode& stiffest);

}  // namespace cloth
