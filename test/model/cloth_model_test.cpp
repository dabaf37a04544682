#include "cloth_sim/model/cloth_model.h"

#include <map>
#include <set>
#include <stdexcept>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support.h"

namespace cloth
{
namespace
{

using Ends = std::pair<int, int>;

std::map<SpringKind, std::set<Ends>> ends_by_kind(const ClothModel& model)
{
  std::map<SpringKind, std::set<Ends>> ends;
  for (const SpringBatch& batch : model.springs)
  {
    for_each_spring(batch, [&](int i, int j) {
      const bool is_new = ends[batch.kind].insert({ i, j }).second;
      EXPECT_TRUE(is_new) << "a second " << name_of(batch.kind) << " spring joins " << i << " and " << j;
    });
  }
  return ends;
}

/// The table of Provot's springs, node by node.
std::set<Ends> expected_ends(const ClothModel& model, const std::vector<std::pair<int, int>>& steps)
{
  std::set<Ends> ends;
  for (int r = 0; r < model.rows; ++r)
  {
    for (int c = 0; c < model.cols; ++c)
    {
      for (const auto& [down, across] : steps)
      {
        if (r + down < model.rows && c + across >= 0 && c + across < model.cols)
        {
          ends.insert({ model.node(r, c), model.node(r + down, c + across) });
        }
      }
    }
  }
  return ends;
}

class Grid : public testing::TestWithParam<std::pair<int, int>>
{
protected:
  const ClothModel model_ = make_sheet(small_sheet(GetParam().first, GetParam().second));
};

TEST_P(Grid, SpringsJoinTheNodesThatTheirKindJoins)
{
  auto ends = ends_by_kind(model_);
  EXPECT_EQ(ends[SpringKind::structural], expected_ends(model_, { { 0, 1 }, { 1, 0 } }));
  EXPECT_EQ(ends[SpringKind::shear], expected_ends(model_, { { 1, 1 }, { 1, -1 } }));
  EXPECT_EQ(ends[SpringKind::flex], expected_ends(model_, { { 0, 2 }, { 2, 0 } }));
}

TEST_P(Grid, RestLengthsAreTheDistancesAtRest)
{
  for (const SpringBatch& batch : model_.springs)
  {
    for_each_spring(batch, [&](int i, int j) {
      EXPECT_NEAR((model_.rest_positions.row(j) - model_.rest_positions.row(i)).norm(), batch.rest_length, 1e-15);
    });
  }
}

TEST_P(Grid, MassAndAreaAreSharedOutWithoutRest)
{
  for (const MassLumping lumping : { MassLumping::area, MassLumping::uniform })
  {
    SheetProperties sheet = small_sheet(GetParam().first, GetParam().second);
    sheet.mass_lumping = lumping;
    const ClothModel model = make_sheet(sheet);
    EXPECT_NEAR(model.masses.sum(), sheet.mass, 1e-15);
    EXPECT_NEAR(model.areas.sum(), sheet.width * sheet.height, 1e-15);
    EXPECT_TRUE((model.masses / sheet.mass).isApprox(model.areas / (sheet.width * sheet.height)));
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Grid,
                         testing::Values(std::pair(5, 6), std::pair(2, 2), std::pair(3, 2), std::pair(2, 1),
                                         std::pair(1, 2), std::pair(9, 1), std::pair(1, 9)));

TEST(ClothModel, AreaLumpingGivesEdgesHalfAndCornersAQuarter)
{
  const ClothModel model = make_sheet(small_sheet());
  const double inside = model.masses[model.node(2, 2)];
  EXPECT_DOUBLE_EQ(model.masses[model.node(0, 2)], 0.5 * inside);
  EXPECT_DOUBLE_EQ(model.masses[model.node(2, 5)], 0.5 * inside);
  EXPECT_DOUBLE_EQ(model.masses[model.node(4, 0)], 0.25 * inside);
}

TEST(ClothModel, UniformLumpingGivesEveryNodeTheSame)
{
  SheetProperties sheet = small_sheet();
  sheet.mass_lumping = MassLumping::uniform;
  const ClothModel model = make_sheet(sheet);
  EXPECT_DOUBLE_EQ(model.masses.minCoeff(), model.masses.maxCoeff());
}

TEST(ClothModel, AChainsEndsWeighHalfByArea)
{
  const ClothModel model = make_sheet(small_sheet(5, 1));
  EXPECT_DOUBLE_EQ(model.masses[0], 0.5 * model.masses[2]);
}

TEST(ClothModel, KindsOfNoStiffnessHaveNoBatch)
{
  SheetProperties sheet = small_sheet();
  sheet.shear.stiffness = 0.0;
  sheet.flex.stiffness = 0.0;
  auto ends = ends_by_kind(make_sheet(sheet));
  EXPECT_EQ(ends.size(), 1u);
  EXPECT_EQ(ends.count(SpringKind::structural), 1u);
}

TEST(ClothModel, SpringsWithoutAGapBetweenRowsAreOneRow)
{
  const ClothModel model = make_sheet(small_sheet(9, 1));
  EXPECT_EQ(model.springs.front().rows, 1);
  EXPECT_EQ(model.springs.front().cols, 8);
}

TEST(ClothModel, RestShapeHangsFromTheMiddleOfItsTopEdge)
{
  const ClothModel model = make_sheet(small_sheet());
  EXPECT_TRUE(model.rest_positions.row(model.node(0, 0)).isApprox(Eigen::RowVector3d(-0.25, 0.0, 0.0)));
  EXPECT_TRUE(model.rest_positions.row(model.node(4, 5)).isApprox(Eigen::RowVector3d(0.25, 0.0, -0.3)));
}

TEST(ClothModel, WhatIsNoSheetIsRefused)
{
  for (const auto& [rows, cols] : { std::pair(0, 3), std::pair(3, 0), std::pair(1, 1), std::pair(-2, -2) })
  {
    EXPECT_THROW(make_sheet(small_sheet(rows, cols)), std::invalid_argument) << rows << " x " << cols;
  }
  SheetProperties sheet = small_sheet();
  sheet.mass = 0.0;
  EXPECT_THROW(make_sheet(sheet), std::invalid_argument);
  sheet = small_sheet();
  sheet.width = std::numeric_limits<double>::infinity();
  EXPECT_THROW(make_sheet(sheet), std::invalid_argument);
}

TEST(Triangles, CoverTheSheetAndFaceTheWayOfItsNormal)
{
  const ClothModel model = make_sheet(small_sheet());
  double area = 0.0;
  for (const auto& [a, b, c] : triangles_of(model))
  {
    const Eigen::Vector3d one = (model.rest_positions.row(b) - model.rest_positions.row(a)).transpose();
    const Eigen::Vector3d other = (model.rest_positions.row(c) - model.rest_positions.row(a)).transpose();
    const Eigen::Vector3d twice = one.cross(other);
    EXPECT_GT(twice.y(), 0.0);
    area += 0.5 * twice.norm();
  }
  EXPECT_NEAR(area, 0.15, 1e-15);
  EXPECT_TRUE(triangles_of(make_sheet(small_sheet(5, 1))).empty());
}

TEST(NodeNormals, OfASheetAtRestAreAlongY)
{
  const ClothModel model = make_sheet(small_sheet());
  Vectors normals;
  node_normals(model, model.rest_positions, normals);
  for (int i = 0; i < model.nodes(); ++i)
  {
    EXPECT_TRUE(normals.row(i).isApprox(Eigen::RowVector3d::UnitY()));
  }
}

TEST(NodeNormals, PreferNoDiagonal)
{
  // A sheet with one node lifted is the mirror image of itself; so must its normals be.
  const ClothModel model = make_sheet(small_sheet(5, 5));
  Vectors positions = model.rest_positions;
  positions(model.node(2, 2), 1) = 0.05;
  Vectors normals;
  node_normals(model, positions, normals);
  for (int r = 0; r < 5; ++r)
  {
    for (int c = 0; c < 5; ++c)
    {
      const Eigen::RowVector3d here = normals.row(model.node(r, c));
      const Eigen::RowVector3d mirrored = normals.row(model.node(r, 4 - c));
      EXPECT_NEAR(here.x(), -mirrored.x(), 1e-15);
      EXPECT_NEAR(here.y(), mirrored.y(), 1e-15);
      EXPECT_NEAR(here.z(), mirrored.z(), 1e-15);
    }
  }
}

TEST(NodeNormals, AreZeroWhereThereIsNoArea)
{
  Vectors normals;
  const ClothModel chain = make_sheet(small_sheet(4, 1));
  node_normals(chain, chain.rest_positions, normals);
  EXPECT_TRUE(normals.isZero(0.0));
  const ClothModel sheet = make_sheet(small_sheet());
  node_normals(sheet, Vectors::Zero(sheet.nodes(), 3), normals);
  EXPECT_TRUE(normals.isZero(0.0));
}

}  // namespace
}  // namespace cloth
