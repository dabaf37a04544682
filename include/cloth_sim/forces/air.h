#pragma once

#include <Eigen/Core>

#include "cloth_sim/forces/gusts.h"
#include "cloth_sim/model/cloth_model.h"
#include "cloth_sim/model/node_range.h"

namespace cloth
{

struct AirProperties
{
  double viscous_damping = 0.3;                    ///< N s/m per m2 of sheet
  double wind_coupling = 1.0;                      ///< N s/m per m2 of sheet
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();  ///< the air's velocity without gusts, m/s
  GustProperties gusts;
};

/// The air's force on each node (Provot 1995, section 3.2):
///
///   -C_dis v_i  +  C_vi (n_i . (u - v_i)) n_i
///
/// C_dis and C_vi are `viscous_damping` and `wind_coupling` times the node's area, n_i its normal (`node_normals`), u
/// the wind at the time, gusts included. Without coupling no normal is ever computed. A chain has no normals and feels
/// viscous damping only.
class Air
{
public:
  explicit Air(const AirProperties& properties);

  const AirProperties& properties() const
  {
    return properties_;
  }
  void set_wind(const Eigen::Vector3d& wind)
  {
    properties_.wind = wind;
  }

  /// u at `time` (s), m/s.
  Eigen::Vector3d wind_at(double time) const
  {
    return properties_.wind + gusts_.at(time);
  }
  /// The wind is never faster, m/s.
  double top_speed() const
  {
    return properties_.wind.norm() + gusts_.top_speed();
  }

  /// Adds the force above, in N, to every node.
  void add_forces(const ClothModel& model, double time, const Vectors& positions, const Vectors& velocities,
                  Vectors& forces) const;
  /// The same for the nodes of some whole rows. There must be room for the model.
  void add_forces(const ClothModel& model, double time, const Vectors& positions, const Vectors& velocities,
                  NodeRange nodes, Vectors& forces) const;

  /// Solves (m + h C_dis) v + h C_vi (n . (v - u)) n = m v_given for every node, in closed form: the air of an
  /// implicit step of length h that ends at `time` (s), positions held. Velocities in m/s, h in s.
  void damp_implicitly(const ClothModel& model, double time, const Vectors& positions, double h,
                       Vectors& velocities) const;

  /// Turns the other forces on the nodes of some whole rows, in N, into their accelerations over a time h (s), with the
  /// air at its end, at `time` (s), positions held, and adds h a to the velocities. There must be room for the model.
  /// In closed form, v being the velocity at the beginning:
  ///
  ///   (m + h C_dis) a + h C_vi (n . a) n = f - C_dis v + C_vi (n . (u - v)) n
  void accelerate_implicitly(const ClothModel& model, double time, const Vectors& positions, double h, NodeRange nodes,
                             Vectors& forces, Vectors& velocities) const;

  /// Makes room for what is worked out for each node.
  void make_room_for(const ClothModel& model) const;

  /// Adds -df/dv u = C_dis u + C_vi (n . u) n to every node, in N for `u` in m/s; `normals` as `node_normals` has them
  /// where `is_coupled`, else not looked at. The derivative by the positions, through the normals, is left out: see
  /// SpringJacobian.
  void add_damping_product(const ClothModel& model, const Vectors& normals, const Vectors& u, Vectors& product) const;

  /// The air acts along the normals of this model's nodes.
  bool is_coupled(const ClothModel& model) const;

  /// The smallest rate at which the air slows a node in any direction, C_dis / m, 1/s.
  double least_damping_rate(const ClothModel& model) const;
  /// The largest (C_dis + C_vi) / m of any node, 1/s: the fastest rate at which the air slows a node.
  double damping_rate(const ClothModel& model) const;

private:
  /// The normals, and n . (u - v), of `nodes`.
  void find_normal_speeds(const ClothModel& model, double time, const Vectors& positions, const Vectors& velocities,
                          NodeRange nodes) const;
  /// Adds `normal_speeds_` along the normals of `nodes`.
  void add_along_normals(NodeRange nodes, Vectors& vectors) const;

  AirProperties properties_;
  Gusts gusts_;
  mutable Vectors normals_;
  mutable Eigen::ArrayXd normal_speeds_;
};

}  // namespace cloth
