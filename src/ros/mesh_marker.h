#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <ros/time.h>
#include <visualization_msgs/Marker.h>

#include "cloth_sim/model/cloth_model.h"

#include "reused_messages.h"
#include "ribbon.h"

namespace cloth
{

/// How the mesh is coloured.
struct MeshColouring
{
  Eigen::Vector3d fabric{ 0.75, 0.16, 0.18 };  ///< red, green, blue in [0, 1]
  bool by_strain = false;                      ///< by each node's worst strain instead
  double full_strain = 0.0;                    ///< the strain shown as worst; 0: the worst that there is, from 1 % on
};

/// The cloth as one TRIANGLE_LIST for rviz: two triangles a quad; a chain as a ribbon. Light and shade are in the
/// vertex colours, because rviz leaves the backs of triangles of one uniform colour black. Namespace, id and number of
/// triangles never change, so that rviz updates its buffer in place; the memory is used again once nobody holds the
/// marker.
class MeshMarker
{
public:
  /// `model` must outlive this object. `across` is the direction of a chain's width, a unit vector in frame `frame_id`.
  MeshMarker(const ClothModel& model, const std::string& frame_id, const MeshColouring& colouring,
             const Eigen::Vector3d& across);

  /// The marker of the nodes' `positions` (m, finite). Whoever holds it keeps it as it is.
  visualization_msgs::Marker::ConstPtr update(const Vectors& positions, const ros::Time& stamp);

private:
  const Vectors& lay_surface(const Vectors& positions);
  void find_strains(const Vectors& positions);
  void make_vertices(const Vectors& positions, const Vectors& vertices);
  void fill_marker(visualization_msgs::Marker& marker) const;

  const ClothModel& model_;
  MeshColouring colouring_;
  std::optional<Ribbon> ribbon_;
  std::vector<std::array<int, 3>> triangles_;  ///< of vertices
  Vectors ribbon_vertices_;
  Vectors normals_;                           ///< one row a vertex
  std::vector<geometry_msgs::Point> points_;  ///< one a vertex
  std::vector<std_msgs::ColorRGBA> colours_;
  std::vector<double> strains_;  ///< the worst of each node's structural and shear springs
  ReusedMessages<visualization_msgs::Marker> markers_;
};

}  // namespace cloth
