#pragma once

#include "cloth_sim/constraints/strain_limit.h"
#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/model/cloth_state.h"

namespace cloth
{

/// Finds out when a cloth is at rest, to within a distance: nothing drives it, and going on would take no node farther.
///
/// Forces do not tell: in stiff springs they are large a micrometre from balance. Nor does one moment: a swing stands
/// still where it turns, and what creeps is slow far from rest. So there must be a window in which
///
/// - no node goes farther than the distance from where it was at the beginning. It is 1 s long, and 2/d, d being the
///   least rate at which the air damps (Air::least_damping_rate): so it sees half a swing or the end of the speed,
///   whatever the mode;
/// - no node drifts: its mean places in the two halves differ by a speed that would take it no farther in a hundred
///   times the time in which what the air holds back comes down, D size/|g|, D being the largest rate.
///
/// Then, unless the strain limit holds springs, `settle` is asked whether rest is that close. (The limit, which obeys
/// itself to a tolerance, has the cloth rest beside where statics have it.) After a no the next window is twice as
/// long.
///
/// Where the air damps nothing, and where springs join some nodes to no pin, only a cloth is at rest that does not move
/// by a bit.
class RestWatch
{
public:
  static constexpr double shortest_window = 1.0;       ///< s
  static constexpr double between_looks = 1.0 / 32.0;  ///< s

  /// `distance` in m; 0: nothing counts as rest.
  explicit RestWatch(double distance);

  /// To be called after any change from outside: a window begins.
  void begin(const Dynamics& dynamics, const ClothState& state);
  /// The same of a state that `settle` has found: at rest without a window if nothing drives it.
  void begin_settled(const Dynamics& dynamics, const ClothState& state);

  /// To be called after every step; looks at the positions now and then.
  void look(const ClothState& state)
  {
    if (distance_ > 0.0 && state.time >= next_look_)
    {
      take_look(state);
    }
  }

  /// To be asked every now and then.
  bool finds_rest(const Dynamics& dynamics, const StrainLimit& limit, const ClothState& state);

private:
  /// Looks in one half of a window: sums.
  struct Looks
  {
    int number = 0;
    double time = 0.0;
    Vectors positions;

    void add(const ClothState& state);
  };

  void begin_window(const ClothState& state);
  void take_look(const ClothState& state);
  bool drifts(const Dynamics& dynamics) const;
  bool would_stay(const Dynamics& dynamics, const StrainLimit& limit, const ClothState& state) const;

  double distance_;
  bool is_settled_ = false;
  double window_ = 0.0;  ///< s
  double begin_ = 0.0;   ///< of the window, s
  double next_look_ = 0.0;
  bool has_moved_ = false;  ///< in the window, by a bit
  Vectors positions_;       ///< at its beginning
  Looks halves_[2];
};

}  // namespace cloth
