#include "ribbon.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace cloth
{

Ribbon::Ribbon(const ClothModel& model, const Eigen::Vector3d& across)
  : nodes_(model.nodes()), half_width_(0.5 * (model.cols == 1 ? model.width : model.height)), across_(across)
{
}

std::vector<std::array<int, 3>> Ribbon::triangles() const
{
  std::vector<std::array<int, 3>> triangles;
  for (int v = 0; v + 3 < 2 * nodes_; v += 2)
  {
    triangles.push_back({ v, v + 2, v + 1 });
    triangles.push_back({ v + 1, v + 2, v + 3 });
  }
  return triangles;
}

void Ribbon::lay(const Vectors& positions, Vectors& vertices, Vectors& normals) const
{
  vertices.resize(2 * nodes_, 3);
  normals.resize(2 * nodes_, 3);
  Eigen::Vector3d across = across_;
  for (int i = 0; i < nodes_; ++i)
  {
    const Eigen::RowVector3d way = positions.row(std::min(i + 1, nodes_ - 1)) - positions.row(std::max(i - 1, 0));
    const Eigen::Vector3d along = way.normalized();
    // Along a chain that turns by less than a right angle at each node this never vanishes.
    const Eigen::Vector3d turned = across - across.dot(along) * along;
    if (turned.norm() > 1e-6)
    {
      across = turned.normalized();
    }
    vertices.row(2 * i) = positions.row(i) - half_width_ * across.transpose();
    vertices.row(2 * i + 1) = positions.row(i) + half_width_ * across.transpose();
    normals.row(2 * i) = normals.row(2 * i + 1) = across.cross(along);
  }
}

}  // namespace cloth
