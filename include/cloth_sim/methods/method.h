#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/model/cloth_state.h"

namespace cloth
{

/// The numbers that a method computes in.
enum class Precision
{
  in_double,
  mixed  ///< what a step adds to the state, which stays in doubles, is worked out in single precision
};

/// What a scene may ask of a method. Each method reads what it needs.
struct MethodSettings
{
  double tolerance = 1e-3;  ///< m; the most that an adaptive method's error estimate may be in a step
  int iterations = 10;      ///< projective: local-global iterations a step; xpbd: substeps a step
  double compliance = 1.0;  ///< xpbd: factor on the springs' compliance 1/k; 0: position-based dynamics
  Precision precision = Precision::in_double;  ///< xpbd
};

/// What a step cost, and whether it is what the method promises.
struct StepReport
{
  int force_evaluations = 0;  ///< or passes over all springs of like cost
  int linear_solves = 0;
  int linear_iterations = 0;  ///< of conjugate gradients, in all solves
  int rejected_steps = 0;     ///< tried and thrown away because the error estimate was too large
  int limit_sweeps = 0;       ///< passes of the strain limit within the step
  bool converged = true;      ///< false: the step's equations were left with a residual above the method's bound
};

/// A time-stepping method at work on one cloth.
class Method
{
public:
  virtual ~Method() = default;

  /// Advances `state` by h seconds, pins included; an adaptive method by at most h.
  virtual StepReport step(const Dynamics& dynamics, double h, ClothState& state) = 0;

  /// Forgets what was kept from the last step. To be called whenever something other than the method changed the
  /// state, the pins or the forces.
  virtual void restart()
  {
  }

  /// True: from now on the method keeps the strain below max_strain (0: no limit) at the end of every step, in at most
  /// so many passes there. False: it leaves that to whoever calls `step`.
  virtual bool limit_strain(double /*max_strain*/, int /*passes*/)
  {
    return false;
  }

  /// From now on every step adds to the rows of held nodes of `impulses` what the forces on them come to over the step,
  /// N s: with the quadrature by which the step moves the free nodes, so that what a spring gives to its two ends sums
  /// to zero. Other rows are of no meaning. Null: no longer. The steps are the same either way.
  void record_impulses(Vectors* impulses)
  {
    impulses_ = impulses;
  }

protected:
  bool records() const
  {
    return impulses_ != nullptr;
  }
  /// For steps that record: `forces` (N) for so long (s).
  void add_impulses(double duration, const Vectors& forces)
  {
    if (records())
    {
      *impulses_ += duration * forces;
    }
  }
  Vectors& impulses()
  {
    return *impulses_;
  }

private:
  Vectors* impulses_ = nullptr;
};

/// One mode of a linearised network, x'' = -frequency^2 x - (air_damping + spring_damping) x'.
struct Mode
{
  double frequency = 0.0;       ///< omega, rad/s
  double air_damping = 0.0;     ///< C/m of the air, 1/s
  double spring_damping = 0.0;  ///< c/m of internal damping, 1/s
};

/// What a step of length h does to the energy of an undamped mode, on average over its swing: it changes by the part
/// factor * (omega h)^power, for small omega h. Factor 0: by nothing, as long as the step is stable.
struct EnergyDrift
{
  double factor;
  int power;
};

/// A row of the table of methods: what it is called, promises and costs.
struct MethodRow
{
  const char* name;                             ///< in scene files; also the name of its source file
  int order;                                    ///< of the error in positions and velocities
  double (*stability_limit)(const Mode& mode);  ///< largest stable step, s; infinite: none; 0: no step is stable
  EnergyDrift energy_drift;
  bool conserves_angular_momentum;  ///< exactly, of a free undamped network (linear momentum: all do)
  bool is_adaptive;                 ///< takes steps of its own choice, up to the given one
  bool iterates_locally;            ///< so often a step: on a finer grid that reaches less far
  int force_evaluations;            ///< a step; of a method that solves, the least
  int linear_solves;                ///< a step; of a method that solves, the least
  const char* failure;              ///< what is seen where it fails
  std::unique_ptr<Method> (*make)(const MethodSettings& settings);
};

/// All methods.
const std::vector<MethodRow>& methods();

/// The row of that name, or null.
const MethodRow* find_method(const std::string& name);

}  // namespace cloth
