#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <ros/wall_timer.h>
#include <rosgraph_msgs/Log.h>
#include <tf2_ros/transform_broadcaster.h>

#include "frame_message.h"
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
using PinMessage = cloth_sim::Pin;

constexpr std::uint32_t cols = 9;
constexpr double rate = 30.0;
constexpr double top_speed = 20.0;
constexpr double in_float32 = 1e-6;

Eigen::Isometry3d pose(const Eigen::Vector3d& place, double yaw = 0.0)
{
  return Eigen::Translation3d(place) * Eigen::Isometry3d(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

/// A node whose sheet starts anew before each test; the test moves a frame of its own.
class TfPins : public testing::Test
{
protected:
  void SetUp() override
  {
    ASSERT_TRUE(wait_until([&] { return pins_.getNumSubscribers() > 0 && state_.publishers() > 0; }));
    constexpr std::uint32_t this_test_and_the_node = 2;
    ASSERT_TRUE(wait_until([&] { return log_.publishers() >= this_test_and_the_node; }));
    ASSERT_TRUE(start_over(state_));
    frame_ = std::string("gripper_") + testing::UnitTest::GetInstance()->current_test_info()->name();
  }

  /// Has the frame broadcast `times_a_second`, at the poses that `pose_of` has for the 0th, 1st, ... broadcast.
  void move_frame(double times_a_second, const std::function<Eigen::Isometry3d(int)>& pose_of)
  {
    int count = 0;
    timer_ = node_.createWallTimer(ros::WallDuration(1.0 / times_a_second),
                                   [=](const ros::WallTimerEvent&) mutable { broadcast(pose_of(count++)); });
  }

  void hold_frame(const Eigen::Isometry3d& where)
  {
    move_frame(rate, [=](int) { return where; });
  }

  void broadcast(const Eigen::Isometry3d& where)
  {
    shown_.push_back(where);
    broadcaster_.sendTransform(frame_message(frame_, where, ros::Time::now()));
  }

  void attach(const std::string& name, std::uint32_t row, std::uint32_t col, bool keep_offset)
  {
    pins_.publish(attach_node(name, row, col, frame_, keep_offset));
  }

  /// Waits until the node has seen the frame: another pin goes to where it stands.
  bool wait_until_known()
  {
    constexpr size_t other_corner = cols - 1;
    if (!wait_until([&] { return !shown_.empty(); }))
    {
      return false;
    }
    attach("right", 0, other_corner, false);
    return wait_for_node_at(other_corner, shown_.back().translation());
  }

  bool wait_for_node_at(size_t node, const Eigen::Vector3d& place)
  {
    return state_.wait_for_one(
        [=](const ClothState& state) { return (position_of(state, node) - place).norm() < in_float32; });
  }

  bool wait_for_warning(const std::string& text)
  {
    return wait_until([&] {
      const auto& all = log_.all();
      return std::any_of(all.begin(), all.end(), [&](const rosgraph_msgs::Log& entry) {
        return entry.level == rosgraph_msgs::Log::WARN && entry.msg.find(text) != std::string::npos;
      });
    });
  }

  ros::NodeHandle node_;
  std::string frame_;
  std::vector<Eigen::Isometry3d> shown_;
  Listener<ClothState> state_{ "/cloth_node/state" };
  Listener<rosgraph_msgs::Log> log_{ "/rosout" };
  ros::Publisher pins_ = node_.advertise<PinMessage>("/cloth_node/pin", 100);
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::WallTimer timer_;
};

TEST_F(TfPins, APinIsWithinAMillimetreOfTheTransformThatTheTickRead)
{
  constexpr size_t corner = cols - 1;
  attach("right", 0, corner, false);
  move_frame(30.0, [](int count) { return pose({ 0.5, count / 30.0, 1.5 }); });
  ASSERT_TRUE(state_.wait_for_one([](const ClothState& state) { return position_of(state, corner).y() > 0.01; }));
  state_.forget();
  ASSERT_TRUE(state_.wait_for_one([](const ClothState& state) { return position_of(state, corner).y() > 1.5; }));
  int moved = 0;
  for (size_t i = 1; i < state_.all().size(); ++i)
  {
    const Eigen::Vector3d place = position_of(state_.all()[i], corner);
    EXPECT_TRUE(std::any_of(shown_.begin(), shown_.end(), [&](const Eigen::Isometry3d& frame) {
      return (frame.translation() - place).norm() < 1e-3;
    })) << place.transpose();
    const Eigen::Vector3d way = place - position_of(state_.all()[i - 1], corner);
    EXPECT_GE(way.y(), -in_float32);
    EXPECT_LT((velocity_of(state_.all()[i], corner) / rate - way).norm(), in_float32)
        << velocity_of(state_.all()[i], corner).transpose();
    moved += way.y() > 0.01 ? 1 : 0;
  }
  EXPECT_GT(moved, 5) << "the pin did not move by steps of a tick";
}

TEST_F(TfPins, NodesTurnWithTheFrame)
{
  hold_frame(pose({ -0.5, -0.2, 1.5 }));
  PinMessage message = pin_within("left", { -0.5, 0.0, 1.5 }, 0.13);
  message.attach_frame = frame_;
  message.keep_offset = 1;
  pins_.publish(message);
  ASSERT_TRUE(
      state_.wait_for_one([](const ClothState& state) { return is_pinned(state, 1) && is_pinned(state, cols); }));
  const Eigen::Isometry3d first = pose({ -0.5, -0.2, 1.5 });
  const std::vector<size_t> nodes{ 0, 1, cols };
  std::vector<Eigen::Vector3d> goals;
  const Eigen::Isometry3d last = pose({ -0.5, -0.1, 1.45 }, 1.2);
  for (const size_t node : nodes)
  {
    goals.push_back(last * first.inverse() * position_of(state_.last(), node));
  }
  ASSERT_TRUE(wait_until_known());
  move_frame(30.0, [](int count) {
    const double part = std::min(1.0, 0.05 * count);
    return pose({ -0.5, -0.2 + 0.1 * part, 1.5 - 0.05 * part }, 1.2 * part);
  });
  EXPECT_TRUE(state_.wait_for_one([&](const ClothState& state) {
    bool there = true;
    for (size_t i = 0; i < nodes.size(); ++i)
    {
      there = there && (position_of(state, nodes[i]) - goals[i]).norm() < in_float32;
    }
    return there;
  }));
}

TEST_F(TfPins, AJumpIsFollowedAtTheTopSpeed)
{
  constexpr size_t corner = 0;
  hold_frame(pose({ -0.5, 0.1, 1.5 }));
  attach("left", 0, corner, false);
  ASSERT_TRUE(wait_for_node_at(corner, { -0.5, 0.1, 1.5 }));
  state_.forget();
  hold_frame(pose({ -0.5, 2.5, 1.5 }));
  EXPECT_TRUE(wait_for_warning("frame '" + frame_ + "' jumped: the pin 'left' follows it at tf_pins.top_speed"));
  ASSERT_TRUE(wait_for_node_at(corner, { -0.5, 2.5, 1.5 }));
  int at_top_speed = 0;
  for (size_t i = 1; i < state_.all().size(); ++i)
  {
    const double way = (position_of(state_.all()[i], corner) - position_of(state_.all()[i - 1], corner)).norm();
    EXPECT_LT(way, top_speed / rate + in_float32);
    at_top_speed += std::abs(way - top_speed / rate) < in_float32 ? 1 : 0;
  }
  EXPECT_GE(at_top_speed, 2);
}

TEST_F(TfPins, APinHoldsItsPlaceWhileItsFrameIsLostAndGoesOnWhenItIsBack)
{
  constexpr size_t corner = 0;
  attach("left", 0, corner, true);
  ASSERT_TRUE(wait_for_warning("the pin 'left' holds its place: tf knows no transform from frame '" + frame_ + "'"));
  const Eigen::Vector3d held = position_of(state_.last(), corner);
  hold_frame(pose({ 0.4, 0.2, 1.4 }));
  ASSERT_TRUE(wait_until_known());
  EXPECT_EQ(position_of(state_.last(), corner), held);
  hold_frame(pose({ 0.4, 0.3, 1.4 }));
  ASSERT_TRUE(wait_for_node_at(corner, held + Eigen::Vector3d(0.0, 0.1, 0.0)));
  const Eigen::Vector3d lost = position_of(state_.last(), corner);
  timer_.stop();
  ASSERT_TRUE(wait_for_warning("the pin 'left' holds its place: the latest transform of frame '" + frame_ + "'"));
  ASSERT_TRUE(state_.wait_for_more(2));
  EXPECT_EQ(position_of(state_.last(), corner), lost);
  EXPECT_TRUE(is_pinned(state_.last(), corner));
  hold_frame(pose({ 0.4, 0.1, 1.4 }));
  EXPECT_TRUE(wait_for_node_at(corner, held - Eigen::Vector3d(0.0, 0.1, 0.0)));
}

TEST_F(TfPins, AMoveTakesAPinOffItsFrame)
{
  constexpr size_t corner = 0;
  hold_frame(pose({ -0.5, 0.2, 1.5 }));
  attach("left", 0, corner, false);
  ASSERT_TRUE(wait_for_node_at(corner, { -0.5, 0.2, 1.5 }));
  pins_.publish(move_pin("left", { -0.4, 0.0, 1.6 }));
  ASSERT_TRUE(wait_for_node_at(corner, { -0.4, 0.0, 1.6 }));
  ASSERT_TRUE(state_.wait_for_more(10));
  EXPECT_LT((position_of(state_.last(), corner) - Eigen::Vector3d(-0.4, 0.0, 1.6)).norm(), in_float32);
}

TEST_F(TfPins, APausedClothFollowsItsFrameWhenItIsStepped)
{
  constexpr size_t corner = 0;
  hold_frame(pose({ -0.5, 0.2, 1.5 }));
  attach("left", 0, corner, false);
  ASSERT_TRUE(wait_for_node_at(corner, { -0.5, 0.2, 1.5 }));
  ASSERT_TRUE(set_paused(true).success);
  hold_frame(pose({ -0.5, 0.3, 1.5 }));
  ASSERT_TRUE(wait_for_standstill(state_));
  EXPECT_LT((position_of(state_.last(), corner) - Eigen::Vector3d(-0.5, 0.2, 1.5)).norm(), in_float32);
  EXPECT_TRUE(wait_until([&] {
    return trigger("step").success == 1 && std::abs(position_of(state_.last(), corner).y() - 0.3) < in_float32;
  }));
  EXPECT_TRUE(set_paused(false).success);
}

TEST_F(TfPins, AReleasedNodeKeepsTheVelocityThatItsFrameGaveIt)
{
  constexpr size_t corner = cols - 1;
  attach("right", 0, corner, false);
  ASSERT_TRUE(set_paused(true).success);
  ASSERT_TRUE(wait_for_standstill(state_));
  move_frame(30.0, [](int count) { return pose({ 0.5, count / 30.0, 1.5 }); });
  const auto step = [&] {
    const double time = state_.last().sim_time;
    return trigger("step").success == 1 &&
           state_.wait_for_one([=](const ClothState& state) { return state.sim_time > time; });
  };
  EXPECT_TRUE(wait_until([&] { return step() && velocity_of(state_.last(), corner).y() > 0.5; }));
  const ClothState before = state_.last();
  pins_.publish(release_pin("right"));
  EXPECT_TRUE(state_.wait_for_one([](const ClothState& state) { return !is_pinned(state, corner); }));
  EXPECT_EQ(state_.last().sim_time, before.sim_time);
  EXPECT_EQ(velocity_of(state_.last(), corner), velocity_of(before, corner));
  EXPECT_TRUE(set_paused(false).success);
}

TEST_F(TfPins, AResetTakesPinsOfTheSceneOffTheirFrames)
{
  constexpr size_t corner = 0;
  hold_frame(pose({ -0.5, 0.2, 1.5 }));
  attach("left", 0, corner, false);
  ASSERT_TRUE(wait_for_node_at(corner, { -0.5, 0.2, 1.5 }));
  ASSERT_TRUE(trigger("reset").success);
  ASSERT_TRUE(wait_for_node_at(corner, { -0.5, 0.0, 1.5 }));
  ASSERT_TRUE(state_.wait_for_more(10));
  EXPECT_LT((position_of(state_.last(), corner) - Eigen::Vector3d(-0.5, 0.0, 1.5)).norm(), in_float32);
}

}  // namespace
}  // namespace cloth
