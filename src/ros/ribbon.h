#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "cloth_sim/model/cloth_model.h"

namespace cloth
{

/// A chain as it is drawn: a thin ribbon of the strip's width, with two vertices a node; those of node i are 2 i and
/// 2 i + 1.
class Ribbon
{
public:
  /// `model` is a chain. `across`, a unit vector in the cloth's frame, is the direction of the width at the first node.
  Ribbon(const ClothModel& model, const Eigen::Vector3d& across);

  /// Two triangles between each pair of neighbours, as vertex indices.
  std::vector<std::array<int, 3>> triangles() const;

  /// Lays the ribbon along the chain's nodes, without twist. `vertices` (m) and unit `normals` get one row a vertex.
  void lay(const Vectors& positions, Vectors& vertices, Vectors& normals) const;

private:
  int nodes_;
  double half_width_;  ///< m
  Eigen::Vector3d across_;
};

}  // namespace cloth
