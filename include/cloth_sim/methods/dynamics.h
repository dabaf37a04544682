#pragma once

#include <Eigen/Core>

#include "cloth_sim/constraints/pins.h"
#include "cloth_sim/forces/air.h"
#include "cloth_sim/model/cloth_model.h"

namespace cloth
{

/// The differential equation that a method advances, m_i a_i = f_i(t, x, v) with the pinned nodes' motion prescribed.
/// Const while stepping.
class Dynamics
{
public:
  Dynamics(ClothModel model, const Eigen::Vector3d& gravity, const AirProperties& air);
  virtual ~Dynamics() = default;

  const ClothModel& model() const
  {
    return model_;
  }
  const Eigen::Vector3d& gravity() const
  {
    return gravity_;
  }
  const Air& air() const
  {
    return air_;
  }
  Air& air()
  {
    return air_;
  }
  const Pins& pins() const
  {
    return pins_;
  }
  Pins& pins()
  {
    return pins_;
  }

  /// The forces that depend on time alone, N: gravity. `forces` is overwritten.
  virtual void external_forces(double time, Vectors& forces) const;

  /// The force on every node but for the air's: springs and external forces, N. `forces` is overwritten.
  void forces_without_air(double time, const Vectors& positions, const Vectors& velocities, Vectors& forces) const;

  /// The force on every node, N. `forces` is overwritten.
  void forces(double time, const Vectors& positions, const Vectors& velocities, Vectors& forces) const;

  /// M^-1 f of every node, in m/s2: of pinned ones what they would do if they were let go. May be done in place.
  void unheld_accelerations_of(const Vectors& forces, Vectors& accelerations) const;

  /// M^-1 f, in m/s2, zero for pinned nodes. May be done in place.
  void accelerations_of(const Vectors& forces, Vectors& accelerations) const;

  /// The acceleration of every node, air included, zero for pinned nodes: the right-hand side as a whole.
  void accelerations(double time, const Vectors& positions, const Vectors& velocities, Vectors& accelerations) const;

private:
  ClothModel model_;
  Eigen::Vector3d gravity_;
  Air air_;
  Pins pins_;
};

}  // namespace cloth
