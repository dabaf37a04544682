#include "pin_requests.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "cloth_sim/scene/plan.h"

#include "refused_request.h"
#include "request_queue.h"
#include "wind_request.h"

namespace cloth
{
namespace
{

constexpr double tick = 1.0 / 30.0;
constexpr double infinity = std::numeric_limits<double>::infinity();

SceneParams free_sheet()
{
  SceneParams scene;
  scene.sheet.rows = 5;
  scene.sheet.cols = 5;
  scene.pins.clear();
  return scene;
}

class PinRequests : public testing::Test
{
protected:
  PinRequests()
  {
    geometry_msgs::TransformStamped turned;
    turned.header.frame_id = "world";
    turned.child_frame_id = "turned";
    turned.transform.translation.x = 1.0;
    turned.transform.rotation.z = turned.transform.rotation.w = std::sqrt(0.5);
    transforms_.setTransform(turned, "test", true);

    request_.action = cloth_sim::Pin::PIN;
    request_.select = cloth_sim::Pin::NODE;
    request_.name = "a";
  }

  void apply()
  {
    apply_pin(request_, frames_, tick, simulation_, attachments_);
  }

  /// The nodes of the pin `name`; none where there is no such pin.
  std::vector<int> held(const std::string& name) const
  {
    const Pin* const pin = simulation_.pins().find(name);
    return pin == nullptr ? std::vector<int>() : pin->nodes;
  }

  tf2::BufferCore transforms_;
  Frames frames_{ "world", transforms_ };
  Simulation simulation_ = build_simulation(make_plan(free_sheet()));
  PinAttachments attachments_{ {} };
  cloth_sim::Pin request_;
};

TEST_F(PinRequests, ByNode)
{
  request_.row = 2;
  request_.col = 3;
  apply();
  EXPECT_EQ(held("a"), std::vector<int>{ 13 });
}

TEST_F(PinRequests, TheNodeNearestToAPointOfAnotherFrame)
{
  request_.select = cloth_sim::Pin::NEAREST;
  request_.point.header.frame_id = "turned";
  const Eigen::Vector3d node = simulation_.state().positions.row(7);
  request_.point.point.x = node.y();
  request_.point.point.y = 1.0 - node.x();
  request_.point.point.z = node.z() + 0.05;
  apply();
  EXPECT_EQ(held("a"), std::vector<int>{ 7 });
}

TEST_F(PinRequests, EveryNodeWithinARadius)
{
  request_.select = cloth_sim::Pin::RADIUS;
  const Eigen::Vector3d node = simulation_.state().positions.row(12);
  request_.point.point.x = node.x();
  request_.point.point.y = node.y();
  request_.point.point.z = node.z();
  request_.radius = 0.26;
  apply();
  EXPECT_EQ(held("a"), (std::vector<int>{ 7, 11, 12, 13, 17 }));
}

TEST_F(PinRequests, ANamelessPinIsCalledByItsNode)
{
  request_.name = "";
  request_.row = 4;
  request_.col = 1;
  apply();
  EXPECT_EQ(held("pin_4_1"), std::vector<int>{ 21 });
}

TEST_F(PinRequests, ANodeNearestToAClickedPointIsCalledByItsRowAndColumn)
{
  geometry_msgs::PointStamped clicked;
  const Eigen::Vector3d node = simulation_.state().positions.row(7);
  clicked.point.x = node.x() + 0.02;
  clicked.point.y = node.y();
  clicked.point.z = node.z() - 0.02;
  request_ = pin_nearest_to(clicked);
  apply();
  EXPECT_EQ(held("pin_1_2"), std::vector<int>{ 7 });
}

TEST_F(PinRequests, MoveEndsWithinOneTickAtThePoint)
{
  apply();
  request_.action = cloth_sim::Pin::MOVE;
  request_.point.point.x = 0.25;
  request_.point.point.z = 1.0;
  apply();
  simulation_.advance_to(tick);
  EXPECT_TRUE(simulation_.state().positions.row(0).isApprox(Eigen::RowVector3d(0.25, 0.0, 1.0), 1e-12));
}

TEST_F(PinRequests, ReleaseByNameAndAllAtOnce)
{
  apply();
  request_.name = "b";
  request_.col = 1;
  apply();
  request_.name = "c";
  request_.col = 2;
  apply();
  request_.action = cloth_sim::Pin::RELEASE;
  request_.name = "b";
  apply();
  EXPECT_EQ(simulation_.pins().all().size(), 2u);
  EXPECT_TRUE(held("b").empty());
  request_.name = "";
  apply();
  EXPECT_TRUE(simulation_.pins().all().empty());
}

TEST_F(PinRequests, NonsenseIsRefusedAndChangesNothing)
{
  const auto refused = [&](void (*spoil)(cloth_sim::Pin&)) {
    cloth_sim::Pin kept = request_;
    spoil(request_);
    EXPECT_THROW(apply(), RefusedRequest);
    request_ = kept;
  };
  refused([](cloth_sim::Pin& pin) { pin.row = 5; });
  refused([](cloth_sim::Pin& pin) { pin.col = 4294967295u; });
  refused([](cloth_sim::Pin& pin) { pin.name = "1a"; });
  refused([](cloth_sim::Pin& pin) { pin.name = "a/b"; });
  refused([](cloth_sim::Pin& pin) { pin.attach_frame = "/turned"; });
  refused([](cloth_sim::Pin& pin) { pin.action = 3; });
  refused([](cloth_sim::Pin& pin) { pin.select = 3; });
  refused([](cloth_sim::Pin& pin) { pin.action = cloth_sim::Pin::RELEASE; });
  refused([](cloth_sim::Pin& pin) { pin.action = cloth_sim::Pin::MOVE; });
  request_.select = cloth_sim::Pin::NEAREST;
  refused([](cloth_sim::Pin& pin) { pin.point.header.frame_id = "nowhere"; });
  refused([](cloth_sim::Pin& pin) { pin.point.header.frame_id = "/turned"; });
  refused([](cloth_sim::Pin& pin) { pin.point.point.z = infinity; });
  refused([](cloth_sim::Pin& pin) { pin.point.point.z = -1e300; });
  request_.select = cloth_sim::Pin::RADIUS;
  request_.radius = 100.0;
  refused([](cloth_sim::Pin& pin) { pin.radius = infinity; });
  refused([](cloth_sim::Pin& pin) { pin.radius = -1.0; });
  refused([](cloth_sim::Pin& pin) { pin.point.point.x = 1000.0; });
  EXPECT_TRUE(simulation_.pins().all().empty());
}

TEST_F(PinRequests, WindIsTurnedButNotShifted)
{
  geometry_msgs::Vector3Stamped wind;
  wind.header.frame_id = "turned";
  wind.vector.x = 3.0;
  EXPECT_TRUE(wind_of(wind, frames_).isApprox(Eigen::Vector3d(0, 3, 0)));
  wind.header.frame_id = "";
  EXPECT_EQ(wind_of(wind, frames_), Eigen::Vector3d(3, 0, 0));
  for (const double bad : { infinity, 1e300, 1001.0 })
  {
    wind.vector.y = bad;
    EXPECT_THROW(wind_of(wind, frames_), RefusedRequest) << bad;
  }
}

TEST_F(PinRequests, WaitInOrderAndTheLatestWindCounts)
{
  RequestQueue queue;
  queue.leave([](Simulation& simulation) { simulation.hold("a", { 3 }); });
  queue.leave([](Simulation& simulation) { simulation.hold("a", { 4 }); });
  queue.leave_wind({ 1, 0, 0 });
  queue.leave_wind({ 2, 0, 0 });
  for (const auto& request : queue.take_all())
  {
    request(simulation_);
  }
  EXPECT_EQ(held("a"), std::vector<int>{ 4 });
  EXPECT_TRUE(queue.take_all().empty());
  EXPECT_EQ(queue.take_wind(), Eigen::Vector3d(2, 0, 0));
  EXPECT_FALSE(queue.take_wind().has_value());
}

TEST_F(PinRequests, TooManyAreRefused)
{
  RequestQueue queue;
  for (size_t i = 0; i < RequestQueue::most_waiting; ++i)
  {
    queue.leave([](Simulation&) {});
  }
  EXPECT_THROW(queue.leave([](Simulation&) {}), RefusedRequest);
  EXPECT_EQ(queue.take_all().size(), RequestQueue::most_waiting);
}

}  // namespace
}  // namespace cloth
