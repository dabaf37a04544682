#include "mesh_marker.h"

#include <algorithm>
#include <cmath>

#include "conversions.h"
#include "shading.h"

namespace cloth
{
namespace
{

/// Strains below this are too small to be given all of the colours.
constexpr double least_full_strain = 0.01;

}  // namespace

MeshMarker::MeshMarker(const ClothModel& model, const std::string& frame_id, const MeshColouring& colouring,
                       const Eigen::Vector3d& across)
  : model_(model), colouring_(colouring)
{
  if (model.is_chain())
  {
    ribbon_.emplace(model, across);
  }
  triangles_ = ribbon_ ? ribbon_->triangles() : triangles_of(model);
  colours_.resize(static_cast<size_t>(model.nodes()) * (ribbon_ ? 2 : 1));
  points_.resize(colours_.size());
  strains_.resize(static_cast<size_t>(model.nodes()));

  visualization_msgs::Marker marker;
  marker.header.frame_id = frame_id;
  marker.ns = "cloth";
  marker.type = visualization_msgs::Marker::TRIANGLE_LIST;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  marker.color = to_colour(colouring.fabric);
  marker.points.resize(3 * triangles_.size());
  marker.colors.resize(3 * triangles_.size());
  markers_ = ReusedMessages<visualization_msgs::Marker>(marker);
}

visualization_msgs::Marker::ConstPtr MeshMarker::update(const Vectors& positions, const ros::Time& stamp)
{
  make_vertices(positions, lay_surface(positions));
  const visualization_msgs::Marker::Ptr marker = markers_.take();
  marker->header.stamp = stamp;
  fill_marker(*marker);
  return marker;
}

const Vectors& MeshMarker::lay_surface(const Vectors& positions)
{
  if (ribbon_)
  {
    ribbon_->lay(positions, ribbon_vertices_, normals_);
    return ribbon_vertices_;
  }
  node_normals(model_, positions, normals_);
  return positions;
}

void MeshMarker::find_strains(const Vectors& positions)
{
  std::fill(strains_.begin(), strains_.end(), 1.0);
  for (const SpringBatch& batch : model_.springs)
  {
    if (batch.kind == SpringKind::flex)
    {
      continue;
    }
    const double scale = 1.0 / (batch.rest_length * batch.rest_length);
    for_each_spring(batch, [&](int i, int j) {
      const double squared_stretch = scale * (positions.row(j) - positions.row(i)).squaredNorm();
      for (const int node : { i, j })
      {
        double& worst = strains_[static_cast<size_t>(node)];
        worst = std::max(worst, squared_stretch);
      }
    });
  }
  for (double& strain : strains_)
  {
    strain = std::sqrt(strain) - 1.0;
  }
}

void MeshMarker::make_vertices(const Vectors& positions, const Vectors& vertices)
{
  const int vertices_a_node = ribbon_ ? 2 : 1;
  double full_strain = colouring_.full_strain;
  if (colouring_.by_strain)
  {
    find_strains(positions);
    if (full_strain == 0.0)
    {
      full_strain = std::max(least_full_strain, *std::max_element(strains_.begin(), strains_.end()));
    }
  }
  for (size_t v = 0; v < colours_.size(); ++v)
  {
    points_[v] = to_point(vertices, static_cast<int>(v));
    const Eigen::Vector3d normal = normals_.row(static_cast<Eigen::Index>(v));
    const size_t node = v / static_cast<size_t>(vertices_a_node);
    colours_[v] = to_colour(colouring_.by_strain ? softly_lit(strain_colour(strains_[node], full_strain), normal) :
                                                   lit(colouring_.fabric, normal));
  }
}

void MeshMarker::fill_marker(visualization_msgs::Marker& marker) const
{
  size_t corner = 0;
  for (const auto& triangle : triangles_)
  {
    for (const int vertex : triangle)
    {
      marker.points[corner] = points_[static_cast<size_t>(vertex)];
      marker.colors[corner] = colours_[static_cast<size_t>(vertex)];
      ++corner;
    }
  }
}

}  // namespace cloth
