#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

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

/// A rigid way between two times: a point of the body, `pivot`, goes in a straight line while the body turns about it
/// at a constant rate; at rest before and after. The velocities at `start` and `end` are those of the way, also where
/// the end is missed by a rounding error: the step that ends there ends in motion.
struct Carry
{
  Eigen::Vector3d from = Eigen::Vector3d::Zero();        ///< displacement of the pivot, m
  Eigen::Vector3d to = Eigen::Vector3d::Zero();          ///< m
  double start = 0.0;                                    ///< s
  double end = 0.0;                                      ///< s
  Eigen::Vector3d pivot = Eigen::Vector3d::Zero();       ///< m, where it is on the body as it was held
  Eigen::Matrix3d turned = Eigen::Matrix3d::Identity();  ///< the turn of the body at `start`, since it was held
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();        ///< the turn on the way: its axis times its angle, rad

  Eigen::Vector3d displacement(double time) const;
  Eigen::Vector3d velocity(double time) const;
  Eigen::Matrix3d rotation(double time) const;
  /// rad/s
  Eigen::Vector3d angular_velocity(double time) const;
  /// The body is not turned, neither before nor on the way.
  bool is_straight() const;
  /// Takes points of the body from where they were held to where they are at `time`.
  Eigen::Isometry3d placement(double time) const;
};

/// Nodes that are held together and moved as one rigid body: x_i(t) = carry(t) held_i + oscillation(t).
struct Pin
{
  std::string name;
  std::vector<int> nodes;
  Vectors held;  ///< m, one row for each of `nodes`
  Oscillation oscillation;
  Carry carry;

  /// The middle of the pin's nodes as they were held, m.
  Eigen::Vector3d held_middle() const;
  /// The middle of the pin's nodes at `time`, m.
  Eigen::Vector3d middle(double time) const;
  /// The largest distance of a node from their middle, m.
  double reach() const;
  /// Whether it oscillates, or is on its way at `time`; else it stays where it is until it is sent elsewhere.
  bool moves_at(double time) const;
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
  /// straight line, and keeps it there; turned as it is at `start`. False: no pin has this name.
  bool carry(const std::string& name, const Eigen::Vector3d& target, double start, double end);
  /// Carries the named pin between the times `start` and `end` (s) to where `placement` takes its nodes from where they
  /// were held, and keeps it there. `pivot` (m, on the body as it was held) goes in a straight line; the turn is the
  /// shorter of the two. An oscillation goes on. False: no pin has this name.
  bool carry(const std::string& name, const Eigen::Isometry3d& placement, const Eigen::Vector3d& pivot, double start,
             double end);

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
  /// 1/m of every node, 0 of those that are held, in 1/kg. What `inverse_masses` has beyond is left as it is.
  void find_inverse_masses(const Eigen::VectorXd& masses, Eigen::VectorXd& inverse_masses) const;
  /// Zeroes the rows of the held nodes: forces and accelerations do not move them.
  void clear_held(Vectors& rows) const;

private:
  Pin* look_up(const std::string& name);
  void mark_held();

  std::vector<Pin> pins_;
  std::vector<char> held_;
};

}  // namespace cloth
