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
/// Now and then the parts that nodes have in `spectrum_bounds` tell how much stiffer or more damped the network may
/// have become since its spectrum was taken; where that is a twentieth, the limit is worked out anew. A look takes as
/// long as two to four steps. There are 8 to 64 steps between two looks: as many as will change the bounds by a
/// fiftieth if they go on to change as they have. Lanczos takes as long as some 20, or 50 where internal damping
/// matters, so there are at least 512 steps between two spectra. Where the limit is wanted sooner it follows from the
/// last spectrum, grown as the bounds have: an estimate, but never above what the bounds alone allow.
///
/// Steps that are known to be short enough need less: none of it where the network in whatever shape is stable at them,
/// and no Lanczos where the bounds say that it is.
class StabilityWatch
{
public:
  /// The limit in s after so many steps; infinite where there is none. What is at least `enough` (s) may be smaller
  /// than the limit.
  double limit(const MethodRow& method, const Dynamics& dynamics, const ClothState& state, std::uint64_t steps,
               double enough = std::numeric_limits<double>::infinity());

  /// To be called when pins or springs have changed.
  void forget()
  {
    known_ = false;
    spectrum_.reset();
    of_any_shape_.reset();
  }

  /// Steps, from one look at the cloth to the next as it moves now: in between the limit stays as it is.
  std::uint64_t steps_between_looks() const
  {
    return steps_between_looks_;
  }

private:
  std::uint64_t delay_of_next_look(const SpectrumBounds& bounds, std::uint64_t steps) const;
  void take_spectrum(const MethodRow& method, const Dynamics& dynamics, const ClothState& state, std::uint64_t steps);
  SpectrumBounds likely(SpectrumBounds bounds) const;

  std::optional<double> of_any_shape_;
  bool known_ = false;
  double limit_ = 0.0;
  bool is_exact_ = false;        ///< the limit: it follows from the spectrum
  SpectrumBounds bounds_;        ///< of when the limit was worked out
  SpectrumBounds seen_;          ///< at the last look
  std::uint64_t looked_at_ = 0;  ///< steps
  std::uint64_t steps_between_looks_ = 64;
  std::optional<Spectrum> spectrum_;  ///< the last one that was taken
  SpectrumBounds spectrum_bounds_;    ///< of then
  std::uint64_t spectrum_at_ = 0;     ///< steps
};

}  // namespace cloth
