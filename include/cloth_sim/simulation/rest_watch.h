#pragma once

#include "cloth_sim/constraints/strain_limit.h"
#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/model/cloth_state.h"

namespace cloth
{

/// Finds out when a cloth is at rest: nothing drives it, no node moves any more, and none would.
///
/// Forces do not tell: in stiff springs they are large a micrometre from balance. Nor does one moment: a swing stands
/// still where it turns, and what creeps is slow far from rest. So there must be a window in which no node goes farther
/// than the distance from where it was at its beginning; and then the positions must be that close to those that
/// `settle` finds from them.
///
/// The window is 1 s, and at least 2/d, d being the least rate at which the air damps (Air::least_damping_rate), so
/// that it sees half a swing or the end of the speed, whatever the mode. Where the air damps nothing only a cloth is at
/// rest that no longer moves at all; so it is, too, where springs join some nodes to no pin.
class RestWatch
{
public:
  /// s
  static constexpr double shortest_window = 1.0;

  /// `distance` in m; 0: nothing counts as rest. With `starts_settled` the first question needs no window, if nothing
  /// has a speed.
  RestWatch(double distance, bool starts_settled);

  /// To be called after any change from outside: from `state` on a window begins.
  void begin(const ClothState& state);

  /// To be asked every now and then as time goes on; mostly the answer costs a look at the positions.
  bool finds_rest(const Dynamics& dynamics, const StrainLimit& limit, const ClothState& state);

private:
  void begin_window(const ClothState& state);
  bool would_stay(const Dynamics& dynamics, const StrainLimit& limit, const ClothState& state) const;

  double distance_;
  bool starts_settled_;
  double patience_ = 1.0;   ///< factor on the window: each answer that cost much and was no doubles it
  bool has_moved_ = false;  ///< in the window, by a bit
  double begin_ = 0.0;      ///< of the window, s
  Vectors positions_;       ///< then
};

}  // namespace cloth
