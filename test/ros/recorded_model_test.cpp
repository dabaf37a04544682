#include "recorded_model.h"

#include <gtest/gtest.h>

#include "mesh_marker.h"
#include "messages.h"
#include "refused_request.h"
#include "spring_marker.h"

namespace cloth
{
namespace
{

SheetProperties properties_of(int rows, int cols)
{
  SheetProperties properties;
  properties.rows = rows;
  properties.cols = cols;
  properties.height = 0.7;
  return properties;
}

TEST(RecordedModel, IsDrawnAsTheModelThatWasRecorded)
{
  for (const auto& sheet : { properties_of(6, 4), properties_of(7, 1), properties_of(1, 7), properties_of(2, 2) })
  {
    const ClothModel live = make_sheet(sheet);
    const ClothModel recorded = recorded_model(topology_message(live, 1), sheet);
    EXPECT_NEAR(recorded.width, live.width, 1e-7);
    EXPECT_NEAR(recorded.height, live.height, 1e-7);
    const Vectors& positions = live.rest_positions;
    const MeshColouring by_strain{ { 0.75, 0.16, 0.18 }, true, 0.1 };
    const auto mesh = [&](const ClothModel& model) {
      return MeshMarker(model, "world", by_strain, Eigen::Vector3d::UnitY()).update(positions, ros::Time(1.0));
    };
    EXPECT_EQ(mesh(recorded)->points.size(), mesh(live)->points.size());
    const auto springs = [&](const ClothModel& model) {
      return SpringMarker(model, "world").update(positions, ros::Time(1.0));
    };
    EXPECT_EQ(springs(recorded)->points, springs(live)->points);
    EXPECT_EQ(springs(recorded)->colors, springs(live)->colors);
  }
}

class BrokenTopology : public testing::Test
{
protected:
  void expect_refused()
  {
    EXPECT_THROW(recorded_model(topology_, SheetProperties()), RefusedRequest);
  }

  cloth_sim::ClothTopology topology_ = topology_message(make_sheet(properties_of(6, 4)), 1);
};

TEST_F(BrokenTopology, AListThatDoesNotFit)
{
  const auto whole = topology_;
  topology_.rest_positions.pop_back();
  expect_refused();
  topology_ = whole;
  topology_.masses.clear();
  expect_refused();
  topology_ = whole;
  topology_.spring_kinds.pop_back();
  expect_refused();
  topology_ = whole;
  topology_.spring_nodes.back() = 24;
  expect_refused();
  topology_ = whole;
  topology_.triangles[0] = 3;
  expect_refused();
}

TEST_F(BrokenTopology, AnEmptyOrAHugeGrid)
{
  topology_.rows = 0;
  expect_refused();
  topology_.rows = topology_.cols = 4000000000;
  expect_refused();
}

}  // namespace
}  // namespace cloth
