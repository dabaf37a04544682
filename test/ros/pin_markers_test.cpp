#include "pin_markers.h"

#include <gtest/gtest.h>

#include "cloth_sim/model/cloth_model.h"

namespace cloth
{
namespace
{

using visualization_msgs::Marker;

class PinMarkersTest : public testing::Test
{
protected:
  const ClothModel model_ = make_sheet(SheetProperties());
  Vectors positions_ = model_.rest_positions;
  std::vector<Pin> pins_{ { "a", { 0, 1 }, {}, {}, {} }, { "b", { 5 }, {}, {}, {} } };
  PinMarkers markers_{ model_, "world" };
};

TEST_F(PinMarkersTest, EachPinHasASphereForEachNode)
{
  const auto message = markers_.update(pins_, positions_, ros::Time(1.0));
  ASSERT_NE(message, nullptr);
  ASSERT_EQ(message->markers.size(), 2u);
  EXPECT_EQ(message->markers[0].ns, "a");
  EXPECT_EQ(message->markers[0].points.size(), 2u);
  EXPECT_EQ(message->markers[1].points[0].x, positions_(5, 0));
}

TEST_F(PinMarkersTest, NothingNewIsNoMessage)
{
  markers_.update(pins_, positions_, ros::Time(1.0));
  positions_(100, 0) += 1.0;
  EXPECT_EQ(markers_.update(pins_, positions_, ros::Time(2.0)), nullptr);
  positions_(5, 0) += 1.0;
  EXPECT_NE(markers_.update(pins_, positions_, ros::Time(3.0)), nullptr);
}

TEST_F(PinMarkersTest, APinThatIsGoneIsDeletedOnce)
{
  markers_.update(pins_, positions_, ros::Time(1.0));
  pins_.erase(pins_.begin());
  auto message = markers_.update(pins_, positions_, ros::Time(2.0));
  ASSERT_NE(message, nullptr);
  ASSERT_EQ(message->markers.size(), 2u);
  EXPECT_EQ(message->markers[0].ns, "a");
  EXPECT_EQ(message->markers[0].action, Marker::DELETE);
  EXPECT_EQ(message->markers[1].ns, "b");
  EXPECT_EQ(message->markers[1].action, Marker::ADD);
  EXPECT_EQ(markers_.update(pins_, positions_, ros::Time(3.0)), nullptr);
}

TEST_F(PinMarkersTest, AFreeSheetSaysSoOnce)
{
  const auto message = markers_.update({}, positions_, ros::Time(1.0));
  ASSERT_NE(message, nullptr);
  EXPECT_TRUE(message->markers.empty());
  EXPECT_EQ(markers_.update({}, positions_, ros::Time(2.0)), nullptr);
}

}  // namespace
}  // namespace cloth
