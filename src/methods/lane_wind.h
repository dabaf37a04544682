#pragma once

#include <vector>

#include <Eigen/Core>

#include "cloth_sim/forces/air.h"
#include "cloth_sim/model/cloth_model.h"

#include "../model/lane_nodes.h"
#include "../model/spring_layout.h"

namespace cloth
{

/// The wind along the normals of a sheet's nodes, as Air::damp_implicitly has it, 16 nodes at a time in single
/// precision.
class LaneWind
{
public:
  /// A chain has no quads, and no wind is to be prepared for it.
  LaneWind(const ClothModel& model, const LaneLayout& layout);

  /// To be called whenever the step's length h (s), the air's properties or the held nodes have changed. Nodes of
  /// inverse mass 0 are held.
  void prepare(const ClothModel& model, const AirProperties& air, double h, const LaneLayout& layout,
               const LaneNodes& nodes);

  /// Changes the ways of a step that viscous damping has been at, by the wind's, of whose air `way` (m) is the own one.
  void blow(const Eigen::Vector3f& way, LaneNodes& nodes);

private:
  /// A vector of quads, a b above c d: the numbers of their nodes.
  struct Quads
  {
    int a;
    int b;
    int c;
    int d;
    int n;
  };

  template <bool fused>
  void blow_in_vectors(const Eigen::Vector3f& way, float* nodes);

  std::vector<Quads> quads_;
  int vectors_;           ///< of nodes
  LaneVectors normals_;   ///< of no particular length; 0 between calls
  LaneBlocks<1> shares_;  ///< how much of the difference to the air's way along the normal a step takes away
};

}  // namespace cloth
