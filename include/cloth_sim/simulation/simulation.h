#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cloth_sim/constraints/pins.h"
#include "cloth_sim/constraints/strain_limit.h"
#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/methods/method.h"
#include "cloth_sim/model/cloth_state.h"
#include "cloth_sim/model/part_calls.h"
#include "cloth_sim/simulation/divergence_guard.h"
#include "cloth_sim/simulation/energy.h"
#include "cloth_sim/simulation/error_watch.h"
#include "cloth_sim/simulation/rest_watch.h"
#include "cloth_sim/simulation/stability_watch.h"

namespace cloth
{

/// All that a simulation starts from.
struct SimulationSetup
{
  ClothModel model;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< m/s2
  AirProperties air;
  std::vector<Pin> pins;
  StrainLimitProperties strain_limit;
  const MethodRow* method = nullptr;
  MethodSettings method_settings;
  double time_step = 0.0;  ///< s; 0: 0.9 of the stability limit as it is, or 1/240 where there is none; of an adaptive
                           ///< method the largest step, 0: none
  bool keeps_within_limit = false;  ///< a given step is shortened to 0.9 of the stability limit where it is longer
  int threads = 1;                  ///< the most that share a step; 0: those of the machine, `chosen_threads` at most
  ClothState start;
  bool start_is_settled = false;  ///< `settle` found it, and nothing was changed since
  double sleep_distance = 0.0;    ///< m; it sleeps where going on would move no node farther; 0: never
  ErrorBounds error_bounds;       ///< steps of a method that does not choose them are corrected to keep these
};

/// A force and its torque.
struct Wrench
{
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< N m
};

/// One cloth on its way through time. Owned by one thread; requests are taken between two calls of `advance_to`.
class Simulation
{
public:
  /// The part of the stability limit that is taken where no step is given.
  static constexpr double limit_share = 0.9;
  /// The shortest step, s: a limit below it counts as none that can be kept.
  static constexpr double shortest_step = 1e-9;

  /// Fewer nodes than this are not worth a thread: a step of theirs takes some 15 microseconds.
  static constexpr int nodes_a_thread = 2048;
  /// Where it is not said how many: what was measured, and what a workstation can spare.
  static constexpr int chosen_threads = 2;

  /// What was done since the start.
  struct Counters
  {
    std::uint64_t steps = 0;
    std::uint64_t force_evaluations = 0;
    std::uint64_t linear_solves = 0;
    std::uint64_t linear_iterations = 0;  ///< of conjugate gradients, in all solves
    std::uint64_t rejected_steps = 0;     ///< tried by an adaptive method and thrown away
    std::uint64_t unconverged_steps = 0;  ///< whose equations the method did not solve to its bound
    std::uint64_t limit_sweeps = 0;       ///< passes of the strain limit over the springs
    PartCalls calls;                      ///< of the parts of the model, in steps
  };

  /// Throws std::invalid_argument where the setup's sizes do not fit together or no method is named.
  explicit Simulation(SimulationSetup setup);

  /// The same cloth as it is now, awake, with the properties of `setup`, whose pins and start count for nothing: state,
  /// pins, counters and a divergence carry on; what is stretched beyond a lower strain limit is shortened, and gains no
  /// speed. Its step never exceeds the stability limit, also where one is given. Throws what the constructor throws.
  Simulation gone_over_to(SimulationSetup setup) const;

  /// Advances to `time` (s) in equal steps, as few as the time step allows; where no step is given and the stability
  /// limit falls on the way, the rest of the way is divided anew. An adaptive method divides the way itself. False: the
  /// simulation has diverged, and holds the last good state. `stops`, where given, is asked every now and then; once it
  /// says so the cloth stays where it has got to. A cloth that sleeps is at `time` at once.
  bool advance_to(double time, const std::function<bool()>& stops = {});

  const ClothModel& model() const
  {
    return dynamics_.model();
  }
  const ClothState& state() const
  {
    return state_;
  }
  const Dynamics& dynamics() const
  {
    return dynamics_;
  }
  const Pins& pins() const
  {
    return dynamics_.pins();
  }
  const StrainLimit& strain_limit() const
  {
    return strain_limit_;
  }
  const MethodRow& method() const
  {
    return *method_row_;
  }
  const Counters& counters() const
  {
    return counters_;
  }
  const std::optional<Divergence>& divergence() const
  {
    return divergence_;
  }
  /// Since when it has been asleep, s: it was found at rest (RestWatch), and its velocities are 0. Time goes on without
  /// steps and without a change of any position, until a request that changes something or measures reactions; the
  /// first step goes on from here. Nothing: it is awake.
  const std::optional<double>& asleep_since() const
  {
    return asleep_since_;
  }
  /// Checks of what the steps err by, and the step that they have led to.
  const ErrorWatch& error_watch() const
  {
    return error_watch_;
  }
  /// The divergence in words: when, which node, the step and the stability limit, what to change. Empty: none.
  std::string divergence_report() const;

  /// The step that is taken as the cloth is now, s: the given one, or that which follows from the stability limit as
  /// it was worked out last; of an adaptive method the last that it took.
  double time_step() const;
  /// The largest stable step of the cloth as it is at this moment, s; infinite where there is none.
  double stability_limit() const;

  /// From the next step on adds up what the cloth does to those who hold its nodes, beginning at zero, or adds up no
  /// longer. The motion is the same either way. To be called anew after a request about pins.
  void measure_reactions(bool measure);
  /// What the cloth did to the holder of `pin`, on average since `measure_reactions(true)`; the torque about the middle
  /// of the pin's nodes, and with arms, as they are now. With what a method makes of the forces on held nodes and of
  /// those on free ones, m a of the held nodes included, this keeps the balance
  ///
  ///   change of the momentum of all nodes = impulse of gravity and air on all nodes - sum of all pins' force times
  ///   time
  ///
  /// to rounding, or to the accuracy with which a method solves its equations; the strain limit's part too. Zero where
  /// no time has passed.
  Wrench reaction_on(const Pin& pin) const;

  // Requests. The state carries on. What asks for nothing that is not so already does not wake the cloth.

  void set_wind(const Eigen::Vector3d& wind);
  /// Holds `nodes` where they are. They leave the pins that held them before.
  void hold(const std::string& name, const std::vector<int>& nodes);
  /// Lets the named pin's nodes go, at the velocity that they have. False: no pin has this name.
  bool release(const std::string& name);
  void release_all();
  /// Carries the middle of the named pin's nodes to `target` (m) within `duration` (s). False: no pin has this name.
  bool carry(const std::string& name, const Eigen::Vector3d& target, double duration);
  /// Carries the named pin, until the time `end` (s), to where `placement` takes its nodes from where they were held;
  /// `pivot` (m, on the body as it was held) goes in a straight line. False: no pin has this name.
  bool carry(const std::string& name, const Eigen::Isometry3d& placement, const Eigen::Vector3d& pivot, double end);

private:
  static constexpr int steps_between_checks = 64;

  double longest_step() const;
  double limited_step() const;
  void step(double h);
  void take_equal_steps(double time, double longest);
  void take_adaptive_steps(double time, double longest);
  void keep_or_restore();
  void changed_from_outside();
  void shorten_at_no_speed();
  void sleep_where_at_rest();
  void wake();
  bool is_there(const Pin& pin, const Eigen::Isometry3d& placement) const;
  void pins_sent_elsewhere();

  Dynamics dynamics_;
  StrainLimit strain_limit_;
  const MethodRow* method_row_;
  MethodSettings method_settings_;
  std::unique_ptr<Method> method_;
  double given_time_step_;
  double given_share_ = std::numeric_limits<double>::infinity();  ///< of the stability limit, which a given step keeps
  double last_step_ = 0.0;
  ClothState state_;
  ClothState last_good_;
  DivergenceGuard guard_;
  std::optional<Divergence> divergence_;
  Counters counters_;
  mutable StabilityWatch stability_watch_;
  RestWatch rest_watch_;
  ErrorWatch error_watch_;
  std::optional<double> asleep_since_;

  bool measures_reactions_ = false;
  double measured_since_ = 0.0;
  Vectors velocities_before_;
  Vectors impulses_;  ///< what the cloth gave to held nodes since then, N s, without m a
};

}  // namespace cloth
