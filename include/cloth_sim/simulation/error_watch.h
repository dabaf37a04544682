#pragma once

#include <memory>
#include <optional>

#include "cloth_sim/constraints/strain_limit.h"
#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/methods/method.h"
#include "cloth_sim/model/cloth_state.h"

namespace cloth
{

/// What steps may err by, and how far they may be corrected for that.
struct ErrorBounds
{
  double tolerance = 0.0;     ///< m; root mean square over all nodes and 1 s; 0: nobody asks
  double room = 1.0;          ///< steps shorter than this part of the first ones take too long
  double longest_step = 0.0;  ///< s
};

/// Finds out by step doubling what the steps of a running cloth err by, and which would err by half of the tolerance.
///
/// A check lasts a second of simulated time. Through it the cloth is advanced a second time, from the same state and
/// with steps of half the length. What the two motions differ by gives the error of the longer steps, since the
/// method's order is known (Hairer, Norsett and Wanner, "Solving Ordinary Differential Equations I", II.4). Wind and
/// pins are those of the cloth; a change of its state from outside ends a check without a result.
///
/// Steps are shortened where the error is above the tolerance, and lengthened where two checks in a row find it below
/// an eighth; in between they stay. Where shorter steps do not err less, the motion parts from itself: the step before
/// comes back, and stays. Checks are rarer the longer all is well.
class ErrorWatch
{
public:
  static constexpr double horizon = 1.0;         ///< s, of a check
  static constexpr int samples = 8;              ///< of the two motions, that are compared
  static constexpr double first_check = 4.0;     ///< s after the start
  static constexpr double least_between = 20.0;  ///< s from the end of a check to the next
  static constexpr double most_between = 80.0;   ///< s

  /// Of a cloth that is at `time` (s) now.
  ErrorWatch(const ErrorBounds& bounds, const MethodRow* method, const MethodSettings& settings, double time);

  /// To be called after every step: it took `h` seconds to `state`.
  void look(const Dynamics& dynamics, const StrainLimit& limit, double h, const ClothState& state)
  {
    if (bounds_.tolerance > 0.0 && (other_ || state.time >= next_check_))
    {
      take_look(dynamics, limit, h, state);
    }
  }

  /// The state has changed from outside.
  void state_changed()
  {
    other_.reset();
  }
  /// Forces or the motion of pins have.
  void forces_changed();

  /// The step that the checks have led to, s; nothing: they have found no fault.
  const std::optional<double>& corrected_step() const
  {
    return corrected_step_;
  }

  /// What a check came to.
  struct Finding
  {
    double time;   ///< at its end, s
    double error;  ///< m
    double step;   ///< s
  };
  /// The last check's.
  const std::optional<Finding>& finding() const
  {
    return finding_;
  }

private:
  /// The motion by half steps.
  struct Other
  {
    ClothState state;
    std::unique_ptr<Method> method;
    StrainLimit limit;
  };

  void take_look(const Dynamics& dynamics, const StrainLimit& limit, double h, const ClothState& state);
  void begin_check(const Dynamics& dynamics, const StrainLimit& limit, const ClothState& state);
  void end_check(double time, double h);
  /// The step that errs by half of the tolerance where `h` errs by `error`.
  double fitting_step(double h, double error) const;

  ErrorBounds bounds_;
  const MethodRow* row_;
  MethodSettings settings_;
  std::optional<Other> other_;
  double begin_ = 0.0;  ///< of the check, s
  int compared_ = 0;    ///< samples
  double squares_ = 0.0;
  double next_check_;               ///< s
  double between_ = least_between;  ///< s
  int checks_far_below_ = 0;
  double first_step_ = 0.0;  ///< s
  std::optional<Finding> before_shortening_;
  bool is_at_the_floor_ = false;
  std::optional<double> corrected_step_;
  std::optional<Finding> finding_;
};

}  // namespace cloth
