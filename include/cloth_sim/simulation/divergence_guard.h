#pragma once

#include <optional>
#include <string>

#include "cloth_sim/methods/dynamics.h"
#include "cloth_sim/model/cloth_state.h"

namespace cloth
{

/// Where and why a simulation left what physics allows.
struct Divergence
{
  double time = 0.0;  ///< s
  int node = 0;       ///< the first that is not finite, else the fastest
  std::string cause;
};

/// Watches for values that are not finite, and for kinetic energy far beyond all that can have been put in: what was
/// there at the start, the fall in gravity, the most that the wind can have done, and what moving pins can do.
class DivergenceGuard
{
public:
  /// So many times the energy that can have been put in counts as divergence.
  static constexpr double factor = 10.0;

  /// Starts a new account at `state`: at the start, and after any change from outside.
  void open(const Dynamics& dynamics, const ClothState& state);

  /// Adds what the pins, as they move from now on, can put in: after one was sent elsewhere.
  void allow_pin_motion(const Dynamics& dynamics);

  /// Nothing, or what is wrong with `state`.
  std::optional<Divergence> check(const Dynamics& dynamics, const ClothState& state) const;

private:
  double opening_time_ = 0.0;
  double opening_gravitational_ = 0.0;
  double allowance_ = 0.0;
};

}  // namespace cloth
