#pragma once

#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/methods/method.h"
#include "cloth_sim/model/cloth_state.h"

namespace cloth
{

/// The stability limit of a cloth on its way through time: asked for often, worked out anew when it is 0.2 s old or
/// when the network may have become a twentieth stiffer somewhere.
class StabilityWatch
{
public:
  /// The limit in s; infinite where there is none.
  double limit(const MethodRow& method, const Dynamics& dynamics, const ClothState& state);

  /// To be called when pins or springs have changed.
  void forget()
  {
    known_ = false;
  }

private:
  bool known_ = false;
  double limit_ = 0.0;
  double time_ = 0.0;
  double bound_ = 0.0;
};

}  // namespace cloth
