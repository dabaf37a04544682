#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/methods/method.h"
#include "cloth_sim/methods/spectrum.h"
#include "cloth_sim/model/cloth_state.h"

namespace cloth
{

/// The stability limit of a cloth on its way through time, at a small part of what its steps cost.
///
/// Every 64 steps `spectrum_bounds` tell whether the network may have become a twentieth stiffer or more damped
/// somewhere; then the limit is worked out anew, and when it is 0.2 s old, in which a sheet may unfold, unless
/// these bounds tell of no node that its springs have come to lie otherwise: a sheet that swings flat, or that is at
/// rest, keeps its step. A look takes as long as two to four
/// steps. Lanczos takes as long as some 20, or 50 where internal damping matters, so there are at least 256 steps
/// between two runs of it. Where the limit is wanted sooner it follows from the bounds alone: never too large, and
/// smaller by a fifth at most on shipped scenes. What has not stiffened is given twice the time before that.
///
/// Steps that are known to be short enough need less: none of it where the network in whatever shape is stable at them,
/// and no Lanczos where the bounds say that it is.
class StabilityWatch
{
public:
  /// The limit in s after so many steps; infinite where there is none. What is at least `enough` (s) may be smaller than
  /// the limit.
  double limit(const MethodRow& method, const Dynamics& dynamics, const ClothState& state, std::uint64_t steps,
               double enough = std::numeric_limits<double>::infinity());

  /// To be called when pins or springs have changed.
  void forget()
  {
    known_ = false;
    of_any_shape_.reset();
  }

private:
  std::optional<double> of_any_shape_;
  bool known_ = false;
  bool is_of_bound_ = false;
  double limit_ = 0.0;
  SpectrumBounds bounds_;            ///< of when the limit was worked out
  double time_ = 0.0;                ///< s, likewise
  std::uint64_t worked_out_at_ = 0;  ///< steps, likewise
  std::uint64_t looked_at_ = 0;      ///< steps
};

}  // namespace cloth
