#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <geometry_msgs/PointStamped.h>
#include <gtest/gtest.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>
#include <visualization_msgs/InteractiveMarkerInit.h>
#include <visualization_msgs/InteractiveMarkerUpdate.h>
#include <visualization_msgs/MarkerArray.h>

#include "gripper_frame.h"
#include "listener.h"
#include "pin_message.h"
#include "state_message.h"
#include "state_waits.h"
#include "time_services.h"

namespace cloth
{
namespace
{

using cloth_sim::ClothState;
using visualization_msgs::InteractiveMarkerUpdate;
using visualization_msgs::MarkerArray;
using Feedback = visualization_msgs::InteractiveMarkerFeedback;
using Init = visualization_msgs::InteractiveMarkerInit;
using PinMessage = cloth_sim::Pin;

constexpr size_t cols = 9;
constexpr size_t still_node = 0;
constexpr size_t swinging_node = cols - 1;

Eigen::Vector3d vector_of(const geometry_msgs::Point& point)
{
  return { point.x, point.y, point.z };
}

/// The middle of the two nodes of the pin `still`.
Eigen::Vector3d still_middle(const ClothState& state)
{
  return 0.5 * (position_of(state, still_node) + position_of(state, still_node + 1));
}

bool shows_new(const InteractiveMarkerUpdate& update, const std::string& name)
{
  return std::any_of(update.markers.begin(), update.markers.end(),
                     [&](const auto& marker) { return marker.name == name; });
}

bool erases(const InteractiveMarkerUpdate& update, const std::string& name)
{
  return std::find(update.erases.begin(), update.erases.end(), name) != update.erases.end();
}

const visualization_msgs::InteractiveMarkerPose* pose_in(const InteractiveMarkerUpdate& update, const std::string& name)
{
  const auto found =
      std::find_if(update.poses.begin(), update.poses.end(), [&](const auto& pose) { return pose.name == name; });
  return found == update.poses.end() ? nullptr : &*found;
}

bool places(const InteractiveMarkerUpdate& update, const std::string& name, const Eigen::Vector3d& point)
{
  const auto* const pose = pose_in(update, name);
  return pose != nullptr && (vector_of(pose->pose.position) - point).norm() < 1e-6;
}

bool shows_pin_at(const MarkerArray& markers, const std::string& name, const Eigen::Vector3d& middle)
{
  return std::any_of(markers.markers.begin(), markers.markers.end(), [&](const auto& marker) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const geometry_msgs::Point& point : marker.points)
    {
      sum += vector_of(point);
    }
    return marker.ns == name && marker.action == visualization_msgs::Marker::ADD &&
           (sum / static_cast<double>(marker.points.size()) - middle).norm() < 1e-6;
  });
}

/// A node with a pin of two nodes that stands still, and one of one node that swings; reset before each test. A frame
/// `gripper` is half a metre in front of the sheet's middle, its x axis along the world's y.
class PinHandlesTest : public testing::Test
{
protected:
  static void SetUpTestSuite()
  {
    broadcast_gripper();
  }

  void SetUp() override
  {
    ASSERT_TRUE(wait_until([&] {
      return feedbacks_.getNumSubscribers() > 0 && pins_.getNumSubscribers() > 0 && points_.getNumSubscribers() > 0 &&
             updates_.publishers() > 0 && markers_.publishers() > 0;
    }));
    ASSERT_TRUE(start_over(state_));
  }

  /// What rviz sends when a user does `event` with the handle `name`.
  void send(const std::string& name, std::uint8_t event, const Eigen::Vector3d& point = { 0, 0, 0 },
            const std::string& frame = "world", std::uint32_t menu_entry = 0)
  {
    Feedback feedback;
    feedback.header.frame_id = frame;
    feedback.client_id = "rviz of the test";
    feedback.marker_name = name;
    feedback.control_name = "drag";
    feedback.event_type = event;
    feedback.pose.position.x = point.x();
    feedback.pose.position.y = point.y();
    feedback.pose.position.z = point.z();
    feedback.pose.orientation.w = 1.0;
    feedback.menu_entry_id = menu_entry;
    feedbacks_.publish(feedback);
  }

  void click(const Eigen::Vector3d& point, const std::string& frame)
  {
    geometry_msgs::PointStamped message;
    message.header.frame_id = frame;
    message.point.x = point.x();
    message.point.y = point.y();
    message.point.z = point.z();
    points_.publish(message);
  }

  bool wait_for_still_at(const Eigen::Vector3d& point)
  {
    return state_.wait_for_one([=](const ClothState& state) { return (still_middle(state) - point).norm() < 1e-6; });
  }

  ros::NodeHandle node_;
  Listener<ClothState> state_{ "/cloth_node/state" };
  Listener<MarkerArray> markers_{ "/cloth_node/pins" };
  Listener<InteractiveMarkerUpdate> updates_{ "/cloth_node/pin_handles/update" };
  ros::Publisher feedbacks_ = node_.advertise<Feedback>("/cloth_node/pin_handles/feedback", 100);
  ros::Publisher pins_ = node_.advertise<PinMessage>("/cloth_node/pin", 100);
  ros::Publisher points_ = node_.advertise<geometry_msgs::PointStamped>("/clicked_point", 100);
};

TEST_F(PinHandlesTest, EachPinHasAHandleWithAMenu)
{
  Listener<Init> all("/cloth_node/pin_handles/update_full");
  ASSERT_TRUE(all.wait_for(1));
  ASSERT_EQ(all.last().markers.size(), 2u);
  for (const auto& marker : all.last().markers)
  {
    EXPECT_TRUE(marker.name == "still" || marker.name == "swinging") << marker.name;
    EXPECT_EQ(marker.header.frame_id, "world");
    ASSERT_EQ(marker.menu_entries.size(), 2u);
    EXPECT_EQ(marker.menu_entries[0].title, "release");
    EXPECT_EQ(marker.menu_entries[1].title, "release all");
    ASSERT_EQ(marker.controls.size(), 1u);
  }
}

TEST_F(PinHandlesTest, DraggingAHandleMovesThePin)
{
  const Eigen::Vector3d first = still_middle(state_.last()) + Eigen::Vector3d(0.05, 0.1, -0.1);
  send("still", Feedback::MOUSE_DOWN);
  send("still", Feedback::POSE_UPDATE, first);
  ASSERT_TRUE(wait_for_still_at(first));
  const Eigen::Vector3d second = first + Eigen::Vector3d(0, 0.1, 0);
  send("still", Feedback::POSE_UPDATE, second);
  send("still", Feedback::MOUSE_UP, second);
  EXPECT_TRUE(wait_for_still_at(second));
  EXPECT_TRUE(wait_until([&] {
    const auto& all = markers_.all();
    return std::any_of(all.begin(), all.end(), [&](const auto& one) { return shows_pin_at(one, "still", second); });
  }));
  EXPECT_TRUE(is_pinned(state_.last(), still_node));
}

TEST_F(PinHandlesTest, AMouseOfAnotherFrame)
{
  send("still", Feedback::POSE_UPDATE, { -0.2, 0.4, 0.05 }, "gripper");
  EXPECT_TRUE(wait_for_still_at({ -0.4, 0.3, 1.05 }));
  send("still", Feedback::MOUSE_UP);
}

TEST_F(PinHandlesTest, TheMenuReleasesOnePinOrAll)
{
  send("still", Feedback::MENU_SELECT, { 0, 0, 0 }, "world", 1);
  ASSERT_TRUE(updates_.wait_for_one([](const auto& update) { return erases(update, "still"); }));
  ASSERT_TRUE(state_.wait_for_one([](const ClothState& state) { return !is_pinned(state, still_node); }));
  EXPECT_TRUE(is_pinned(state_.last(), swinging_node));
  pins_.publish(pin_node("another", 4, 4));
  ASSERT_TRUE(updates_.wait_for_one([](const auto& update) { return shows_new(update, "another"); }));
  send("swinging", Feedback::MENU_SELECT, { 0, 0, 0 }, "world", 2);
  ASSERT_TRUE(updates_.wait_for_one(
      [](const auto& update) { return erases(update, "swinging") && erases(update, "another"); }));
  EXPECT_TRUE(state_.wait_for_one([](const ClothState& state) { return pinned_nodes(state) == 0; }));
}

TEST_F(PinHandlesTest, AHandleFollowsItsPin)
{
  ASSERT_TRUE(updates_.wait_for_one([](const auto& update) { return pose_in(update, "swinging") != nullptr; }));
  const double y = pose_in(updates_.last(), "swinging")->pose.position.y;
  EXPECT_TRUE(updates_.wait_for_one([=](const auto& update) {
    const auto* const pose = pose_in(update, "swinging");
    return pose != nullptr && std::abs(pose->pose.position.y - y) > 0.05;
  }));
  pins_.publish(move_pin("still", { 0, 0, 1.25 }));
  EXPECT_TRUE(updates_.wait_for_one([](const auto& update) { return places(update, "still", { 0, 0, 1.25 }); }));
}

TEST_F(PinHandlesTest, AHandleOfAPinAtRestIsNotSentAgain)
{
  send("swinging", Feedback::MENU_SELECT, { 0, 0, 0 }, "world", 1);
  ASSERT_TRUE(updates_.wait_for_one([](const auto& update) { return erases(update, "swinging"); }));
  updates_.forget();
  ASSERT_TRUE(state_.wait_for_more(20));
  for (const InteractiveMarkerUpdate& update : updates_.all())
  {
    EXPECT_EQ(update.type, InteractiveMarkerUpdate::KEEP_ALIVE);
  }
}

TEST_F(PinHandlesTest, ADraggedHandleStaysWithTheMouse)
{
  const Eigen::Vector3d mouse(0.6, 0.2, 1.2);
  send("swinging", Feedback::MOUSE_DOWN, mouse);
  send("swinging", Feedback::POSE_UPDATE, mouse);
  ASSERT_TRUE(updates_.wait_for_one([&](const auto& update) { return places(update, "swinging", mouse); }));
  updates_.forget();
  ASSERT_TRUE(state_.wait_for_one([&](const ClothState& state) {  // it swings on about the mouse
    send("swinging", Feedback::KEEP_ALIVE, mouse);
    return (position_of(state, swinging_node) - mouse).norm() > 0.02;
  }));
  for (const InteractiveMarkerUpdate& update : updates_.all())
  {
    EXPECT_TRUE(pose_in(update, "swinging") == nullptr || places(update, "swinging", mouse));
  }
  send("swinging", Feedback::MOUSE_UP, mouse);
  EXPECT_TRUE(updates_.wait_for_one([&](const auto& update) {
    return pose_in(update, "swinging") != nullptr && !places(update, "swinging", mouse);
  }));
}

TEST_F(PinHandlesTest, ADragThatFallsSilentIsOver)
{
  const Eigen::Vector3d mouse(0.6, 0.2, 1.2);
  send("swinging", Feedback::POSE_UPDATE, mouse);
  ASSERT_TRUE(updates_.wait_for_one([&](const auto& update) { return places(update, "swinging", mouse); }));
  EXPECT_TRUE(updates_.wait_for_one([&](const auto& update) {
    return pose_in(update, "swinging") != nullptr && !places(update, "swinging", mouse);
  }));
}

TEST_F(PinHandlesTest, AHandleWaitsAtItsGoalWhileTheClothIsPaused)
{
  ASSERT_TRUE(set_paused(true).success);
  const Eigen::Vector3d goal = still_middle(state_.last()) + Eigen::Vector3d(0, 0.1, 0);
  send("still", Feedback::POSE_UPDATE, goal);
  send("still", Feedback::MOUSE_UP, goal);
  EXPECT_TRUE(updates_.wait_for_one([&](const auto& update) { return places(update, "still", goal); }));
  EXPECT_GT((still_middle(state_.last()) - goal).norm(), 0.05);
  ASSERT_TRUE(set_paused(false).success);
  EXPECT_TRUE(wait_for_still_at(goal));
}

TEST_F(PinHandlesTest, AClickedPointPinsTheNodeNearestToIt)
{
  constexpr size_t corner = 8 * cols;
  const Eigen::Vector3d place = position_of(state_.last(), corner);
  // The frame's x is the world's y, its y the world's -x: it stands at (0, 0.5, 1).
  click({ place.y() - 0.5, -place.x() + 0.02, place.z() - 1.0 - 0.02 }, "gripper");
  EXPECT_TRUE(updates_.wait_for_one([](const auto& update) { return shows_new(update, "pin_8_0"); }));
  EXPECT_TRUE(state_.wait_for_one([](const ClothState& state) { return is_pinned(state, corner); }));
}

}  // namespace
}  // namespace cloth
