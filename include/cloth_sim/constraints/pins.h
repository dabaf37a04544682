#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "cloth_sim/model/vectors.h"

namespace cloth
{

/// The prescribed motion A (sin(2 pi f t + phase) - sin phase): no displacement at t = 0.
struct Oscillation
{
  Eigen::Vector3d amplitude = Eigen::Vector3d::Zero();  ///< A, m
  double frequency = 0.0;                               ///< f, Hz
  double phase = 0.0;                                   ///< rad

  Eigen::Vector3d displacement(double time) const;
  Eigen::Vector3d velocity(double time) const;
};

/// A straight way from one displacement to another between two times; at rest before and after. The velocity at `end`
/// is that of the way: it belongs to the step that ends there.
struct Carry
{
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d to = Eigen::Vector3d::Zero();    ///< m
  double start = 0.0;                              ///< s
  double end = 0.0;                                ///< s

  Eigen::Vector3d displacement(double time) const;
  Eigen::Vector3d velocity(double time) const;
};

/// Nodes that are held together and moved as one: x_i(t) = held_i + oscillation(t) + carry(t).
struct Pin
{
  std::string name;
  std::vector<int> nodes;
  Vectors held;  ///< m, one row for each of `nodes`
  Oscillation oscillation;
  Carry carry;

  Eigen::Vector3d displacement(double time) const;
  Eigen::Vector3d velocity(double time) const;
  /// The middle of the pin's nodes at `time`, m.
  Eigen::Vector3d middle(double time) const;
};

/// The pins of one sheet: prescribed motion, exact at every time that a method asks for; no springs are involved.
/// A node belongs to one pin at most.
class Pins
{
public:
  explicit Pins(int nodes);

  /// Adds a pin, or replaces that of the same name. Its nodes leave the pins that held them before; a pin left
  /// without nodes is gone.
  void hold(const Pin& pin);
  /// Lets the nodes of the named pin go. False: no pin has this name.
  bool release(const std::string& name);
  void release_all();
  /// Carries the middle of the named pin's nodes to `target` (m) between the times `start` and `end` (s), in a
  /// straight line, and keeps it there. False: no pin has this name.
  bool carry(const std::string& name, const Eigen::Vector3d& target, double start, double end);

  const std::vector<Pin>& all() const
  {
    return pins_;
  }
  const Pin* find(const std::string& name) const;
  bool holds(int node) const
  {
    return held_[static_cast<size_t>(node)];
  }

  /// Puts the held nodes where they are at `time`, at the velocity that they have then.
  void impose(double time, Vectors& positions, Vectors& velocities) const;
  /// The velocities alone.
  void impose_velocities(double time, Vectors& velocities) const;
  /// Zeroes the rows of the held nodes: forces and accelerations do not move them.
  void clear_held(Vectors& rows) const;

private:
  void mark_held();

  std::vector<Pin> pins_;
  std::vector<char> held_;
};

}  // namespace cloth
