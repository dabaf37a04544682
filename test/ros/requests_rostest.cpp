#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <Eigen/Core>
#include <geometry_msgs/Vector3Stamped.h>
#include <gtest/gtest.h>
#include <rosgraph_msgs/Log.h>
#include <visualization_msgs/MarkerArray.h>

#include "gripper_frame.h"
#include "listener.h"
#include "pin_message.h"
#include "state_message.h"

namespace cloth
{
namespace
{

constexpr int rows = 9;
constexpr int cols = 9;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using cloth_sim::ClothState;
using PinMessage = cloth_sim::Pin;

size_t node_at(int row, int col)
{
  return static_cast<size_t>(row * cols + col);
}

double mean_y(const ClothState& state)
{
  return mean_position(state).y();
}

/// A running node with its two upper corners pinned, still air, and a frame `gripper` half a metre in front of the
/// sheet's middle, its x axis along the world's y.
class Requests : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    broadcast_gripper();
  }

  void SetUp() override
  {
    ASSERT_TRUE(wait_until([&] { return pins_.getNumSubscribers() > 0 && winds_.getNumSubscribers() > 0; }));
    constexpr std::uint32_t this_test_and_the_node = 2;
    ASSERT_TRUE(wait_until([&] { return log_.publishers() >= this_test_and_the_node; }));
    pins_.publish(release_pin(""));
    ASSERT_TRUE(state_.wait_for_one([](const ClothState& state) { return pinned_nodes(state) == 0; }));
    pins_.publish(pin_node("left", 0, 0));
    pins_.publish(pin_node("right", 0, cols - 1));
    ASSERT_TRUE(state_.wait_for_one([](const ClothState& state) { return pinned_nodes(state) == 2; }));
  }

  static geometry_msgs::Vector3Stamped wind(const Eigen::Vector3d& velocity, const std::string& frame = "")
  {
    geometry_msgs::Vector3Stamped message;
    message.header.frame_id = frame;
    message.vector.x = velocity.x();
    message.vector.y = velocity.y();
    message.vector.z = velocity.z();
    return message;
  }

  bool wait_for_pinned(size_t node)
  {
    return state_.wait_for_one([=](const ClothState& state) { return is_pinned(state, node); });
  }

  /// Waits until `condition` has held for two seconds of simulated time: longer than a swing takes.
  bool wait_for_lasting(const std::function<bool(const ClothState&)>& condition)
  {
    double since = std::numeric_limits<double>::infinity();
    return state_.wait_for_one([&](const ClothState& state) {
      since = condition(state) ? std::min(since, state.sim_time) : std::numeric_limits<double>::infinity();
      return state.sim_time - since >= 2.0;
    });
  }

  /// Waits for the node's warning that contains `text`.
  bool wait_for_warning(const std::string& text)
  {
    return wait_until([&] { return warnings_with(text) > 0; });
  }

  int warnings_with(const std::string& text) const
  {
    int count = 0;
    for (const rosgraph_msgs::Log& entry : log_.all())
    {
      count += entry.level == rosgraph_msgs::Log::WARN && entry.msg.find(text) != std::string::npos ? 1 : 0;
    }
    return count;
  }

  /// Sends the message; expects one warning with `text`, and the cloth to go on with the same pins.
  void expect_refused(const PinMessage& message, const std::string& text)
  {
    log_.forget();
    ASSERT_TRUE(state_.wait_for_more(1));
    const auto flags = state_.last().flags;
    pins_.publish(message);
    EXPECT_TRUE(wait_for_warning(text)) << text;
    ASSERT_TRUE(state_.wait_for_more(3));
    EXPECT_EQ(warnings_with(text), 1) << text;
    EXPECT_EQ(state_.last().flags, flags) << text;
  }

  ros::NodeHandle node_;
  Listener<ClothState> state_{ "/cloth_node/state" };
  Listener<visualization_msgs::MarkerArray> markers_{ "/cloth_node/pins" };
  Listener<rosgraph_msgs::Log> log_{ "/rosout" };
  ros::Publisher pins_ = node_.advertise<PinMessage>("/cloth_node/pin", 100);
  ros::Publisher winds_ = node_.advertise<geometry_msgs::Vector3Stamped>("/cloth_node/wind", 100);
};

TEST_F(Requests, APinHoldsANodeWhereItIs)
{
  const size_t corner = node_at(rows - 1, 0);
  pins_.publish(pin_node("corner", rows - 1, 0));
  ASSERT_TRUE(wait_for_pinned(corner));
  const Eigen::Vector3d held = position_of(state_.last(), corner);
  ASSERT_TRUE(state_.wait_for_more(10));
  EXPECT_EQ(position_of(state_.last(), corner), held);
}

TEST_F(Requests, APinWithoutANameIsCalledByItsNode)
{
  pins_.publish(pin_node("", 3, 4));
  ASSERT_TRUE(wait_for_pinned(node_at(3, 4)));
  pins_.publish(release_pin("pin_3_4"));
  EXPECT_TRUE(state_.wait_for_one([](const ClothState& state) { return !is_pinned(state, node_at(3, 4)); }));
}

TEST_F(Requests, AReleasedNodeFallsAndItsMarkerGoes)
{
  pins_.publish(release_pin("left"));
  ASSERT_TRUE(state_.wait_for_one([](const ClothState& state) { return !is_pinned(state, 0); }));
  const double height = position_of(state_.last(), 0).z();
  EXPECT_TRUE(state_.wait_for_one([=](const ClothState& state) { return position_of(state, 0).z() < height - 0.01; }));
  EXPECT_TRUE(wait_until([&] {
    for (const auto& marker :
         markers_.all().empty() ? std::vector<visualization_msgs::Marker>() : markers_.last().markers)
    {
      if (marker.ns == "left" && marker.action == visualization_msgs::Marker::DELETE)
      {
        return true;
      }
    }
    return false;
  }));
}

TEST_F(Requests, APinIsMovedToAPointOfAnotherFrame)
{
  const size_t corner = node_at(rows - 1, cols - 1);
  pins_.publish(pin_node("corner", rows - 1, cols - 1));
  ASSERT_TRUE(wait_for_pinned(corner));
  // The frame's x is the world's y, its y the world's -x: it stands at (0, 0.5, 1).
  pins_.publish(move_pin("corner", { -0.2, -0.3, 0.05 }, "gripper"));
  const Eigen::Vector3d target(0.3, 0.3, 1.05);
  EXPECT_TRUE(state_.wait_for_one(
      [=](const ClothState& state) { return (position_of(state, corner) - target).norm() < 1e-6; }));
  EXPECT_TRUE(is_pinned(state_.last(), corner));
}

TEST_F(Requests, TheNodeNearestToAPoint)
{
  const Eigen::Vector3d point = position_of(state_.last(), node_at(4, 4));
  pins_.publish(pin_nearest("nearest", point, "world"));
  ASSERT_TRUE(state_.wait_for_one([](const ClothState& state) { return pinned_nodes(state) == 3; }));
  for (size_t node = 1; node < state_.last().flags.size(); ++node)
  {
    if (is_pinned(state_.last(), node) && node != cols - 1)
    {
      EXPECT_LT((position_of(state_.last(), node) - point).norm(), 0.125) << "node " << node;
    }
  }
}

TEST_F(Requests, EveryNodeWithinARadius)
{
  pins_.publish(pin_within("all", { 0, 0, 1 }, 100.0));
  EXPECT_TRUE(state_.wait_for_one([](const ClothState& state) { return pinned_nodes(state) == 1u * rows * cols; }));
}

TEST_F(Requests, WindDeflectsTheSheet)
{
  winds_.publish(wind({ 0, -6, 0 }));
  EXPECT_TRUE(wait_for_lasting([](const ClothState& state) { return mean_y(state) < -0.1; }));
  winds_.publish(wind({ 0, 0, 0 }));
}

TEST_F(Requests, WindTurnsWithItsFrame)
{
  winds_.publish(wind({ 6, 0, 0 }, "gripper"));
  EXPECT_TRUE(wait_for_lasting([](const ClothState& state) { return mean_y(state) > 0.1; }));
  winds_.publish(wind({ 0, 0, 0 }));
}

TEST_F(Requests, WindThatIsNotFiniteIsRefused)
{
  winds_.publish(wind({ 0, nan, 0 }));
  winds_.publish(wind({ 0, nan, 0 }));
  EXPECT_TRUE(wait_for_warning("wind: vector is not finite"));
  ASSERT_TRUE(state_.wait_for_more(5));
  EXPECT_EQ(warnings_with("wind: vector is not finite"), 1);
  EXPECT_TRUE(std::isfinite(mean_y(state_.last())));
}

TEST_F(Requests, WindInAFrameThatTfDoesNotKnowIsRefused)
{
  winds_.publish(wind({ 0, -6, 0 }, "nowhere"));
  EXPECT_TRUE(wait_for_warning("frame 'nowhere'"));
  EXPECT_TRUE(state_.wait_for_more(5));
}

TEST_F(Requests, PinsThatMakeNoSenseAreRefused)
{
  expect_refused(pin_node("a", rows, 0), "row 9, col 0");
  expect_refused(pin_node("a", 0, -1), "col 4294967295");
  expect_refused(pin_node("a b", 1, 1), "name is a b");
  expect_refused(pin_node("/a", 1, 1), "name is /a");
  expect_refused(release_pin("nobody"), "name 'nobody'");
  expect_refused(move_pin("somebody", { 0, 0, 0 }), "name 'somebody'");
  expect_refused(move_pin("left", { nan, 0, 0 }), "point is not finite");
  expect_refused(pin_nearest("a", { 0, 0, 0 }, "elsewhere"), "frame 'elsewhere'");

  PinMessage message = pin_within("a", { 0, 0, 9 }, 0.1);
  expect_refused(message, "no node lies within");
  message.radius = nan;
  expect_refused(message, "radius is nan");
  message.select = 7;
  expect_refused(message, "select is 7");
  message.action = 8;
  expect_refused(message, "action is 8");
  expect_refused(attach_node("a", 1, 1, "/gripper", false), "attach_frame is '/gripper'");
}

}  // namespace
}  // namespace cloth
