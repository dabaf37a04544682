#include "mesh_marker.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "conversions.h"
#include "support.h"

namespace cloth
{
namespace
{

ClothModel model_of(int rows, int cols)
{
  SheetProperties properties;
  properties.rows = rows;
  properties.cols = cols;
  return make_sheet(properties);
}

Eigen::Vector3d corner(const visualization_msgs::Marker& marker, size_t index)
{
  return to_eigen(marker.points[index]);
}

double area_of(const visualization_msgs::Marker& marker)
{
  double area = 0.0;
  for (size_t c = 0; c < marker.points.size(); c += 3)
  {
    const Eigen::Vector3d a = corner(marker, c + 1) - corner(marker, c);
    const Eigen::Vector3d b = corner(marker, c + 2) - corner(marker, c);
    area += 0.5 * a.cross(b).norm();
  }
  return area;
}

TEST(MeshMarker, CoversTheSheet)
{
  const ClothModel model = model_of(5, 4);
  MeshMarker mesh(model, "world", {}, Eigen::Vector3d::UnitX());
  EXPECT_NEAR(area_of(*mesh.update(model.rest_positions, ros::Time(1.0))), 1.0, 1e-12);
}

TEST(MeshMarker, UsesItsMemoryAgainOnceNobodyHoldsIt)
{
  const ClothModel model = model_of(5, 4);
  MeshMarker mesh(model, "world", {}, Eigen::Vector3d::UnitX());
  const auto* const points = mesh.update(model.rest_positions, ros::Time(1.0))->points.data();
  const auto second = mesh.update(2.0 * model.rest_positions, ros::Time(2.0));
  EXPECT_EQ(second->points.data(), points);
  EXPECT_NEAR(area_of(*second), 4.0, 1e-12);
  const auto third = mesh.update(3.0 * model.rest_positions, ros::Time(3.0));
  EXPECT_NEAR(area_of(*second), 4.0, 1e-12);
  EXPECT_EQ(second->header.stamp, ros::Time(2.0));
  EXPECT_NEAR(area_of(*third), 9.0, 1e-12);
}

TEST(MeshMarker, AChainIsARibbonOfItsStripsWidth)
{
  for (const bool down : { true, false })
  {
    SheetProperties properties;
    properties.rows = down ? 6 : 1;
    properties.cols = down ? 1 : 6;
    (down ? properties.width : properties.height) = 0.1;
    const ClothModel model = make_sheet(properties);
    MeshMarker mesh(model, "world", {}, down ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ());
    const auto& marker = *mesh.update(model.rest_positions, ros::Time(1.0));
    EXPECT_EQ(marker.points.size(), 3u * 2u * 5u);
    EXPECT_NEAR(area_of(marker), 0.1, 1e-12);
    for (const auto& colour : marker.colors)
    {
      EXPECT_GT(colour.r, 0.15F);
    }
  }
}

TEST(MeshMarker, ARibbonStaysFiniteWhereTheChainFolds)
{
  const ClothModel model = model_of(5, 1);
  Vectors positions = Vectors::Zero(5, 3);
  positions.col(0) << 0.0, 1.0, 1.0, 1.0, 0.0;  // along its own width, two links of no length, and back
  MeshMarker mesh(model, "world", {}, Eigen::Vector3d::UnitX());
  const auto marker = mesh.update(positions, ros::Time(1.0));
  for (const auto& point : marker->points)
  {
    EXPECT_TRUE(to_eigen(point).allFinite());
  }
}

TEST(MeshMarker, StrainColoursFollowTheWorstSpringOfANode)
{
  const ClothModel model = model_of(3, 3);
  Vectors positions = model.rest_positions;
  positions(0, 0) -= 0.1;  // the first corner, outwards: 20 % of its link
  for (const double full_strain : { 0.2, 0.0 })
  {
    MeshMarker mesh(model, "world", { { 0.75, 0.16, 0.18 }, true, full_strain }, Eigen::Vector3d::UnitX());
    const auto& marker = *mesh.update(positions, ros::Time(1.0));
    const Eigen::Vector3d last = positions.row(8);
    for (size_t c = 0; c < marker.points.size(); ++c)
    {
      if (corner(marker, c) == Eigen::Vector3d(positions.row(0)))
      {
        EXPECT_GT(marker.colors[c].r, 2.0F * marker.colors[c].b);
      }
      if (corner(marker, c) == last)
      {
        EXPECT_GT(marker.colors[c].b, 2.0F * marker.colors[c].r);
      }
    }
  }
}

}  // namespace
}  // namespace cloth
