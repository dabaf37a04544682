#pragma once

#include <chrono>

#include "cloth_sim/simulation/simulation.h"

namespace cloth
{

/// How fast the machine is just now, by the processor's time that a fixed piece of work takes: the forces on a small
/// sheet, again and again. A core whose other hyperthread someone else uses, or whose frequency changes, slows down by
/// half for seconds; a time in lengths of the yardstick does not.
class Yardstick
{
public:
  using WallClock = std::chrono::steady_clock;

  /// The one of this program.
  static Yardstick& shared();

  /// What the work takes, s of processor time; measured again where that was done `freshness` ago or longer.
  double length();

  /// The shortest that it has ever been, s: what it takes on a machine that does nothing else.
  double shortest() const
  {
    return shortest_;
  }

  /// About 20 times what the work takes.
  static constexpr std::chrono::milliseconds freshness{ 20 };

private:
  Yardstick();

  Simulation sheet_;
  Vectors accelerations_;
  double length_;
  double shortest_;
  WallClock::time_point measured_;

  double measured_length();
};

}  // namespace cloth
