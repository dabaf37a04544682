#include "pin_attachments.h"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "cloth_sim/scene/plan.h"

#include "pin_requests.h"
#include "refused_request.h"
#include "ros/frame_message.h"
#include "support.h"

namespace cloth
{
namespace
{

constexpr double tick = 1.0 / 30.0;
constexpr double top_speed = 3.0;
constexpr double max_age = 0.5;

/// A sheet of 5 x 5 nodes, one square metre, whose pin `hand` has the nodes of its upper edge. The frame `gripper` is
/// not at the pin's middle, and is turned.
class PinsOnAFrame : public testing::Test
{
protected:
  PinsOnAFrame()
  {
    ros::Time::init();  // frames ask how old a transform is
    SceneParams scene;
    scene.sheet.rows = scene.sheet.cols = 5;
    scene.pins.clear();
    simulation_.emplace(build_simulation(make_plan(scene)));
    simulation_->hold("hand", { 0, 1, 2, 3, 4 });
    held_ = simulation_->pins().find("hand")->held;
    show(first_);
  }

  void show(const Eigen::Isometry3d& gripper)
  {
    show(gripper, now_);
  }

  void show(const Eigen::Isometry3d& gripper, const ros::Time& stamp)
  {
    transforms_.setTransform(frame_message("gripper", gripper, stamp), "test");
  }

  void run_tick()
  {
    warnings_.clear();
    now_ += ros::Duration(tick);
    end_ += tick;
    attachments_.carry(frames_, now_, end_, *simulation_, [this](const std::string& text) { warnings_ += text; });
    ASSERT_TRUE(simulation_->advance_to(end_)) << simulation_->divergence_report();
  }

  void expect_hand_at(const Eigen::Isometry3d& placement) const
  {
    for (int i = 0; i < 5; ++i)
    {
      const Eigen::Vector3d place = placement * held_.row(i).transpose();
      const Eigen::Vector3d position = simulation_->state().positions.row(i);
      EXPECT_LT((position - place).norm(), 1e-12) << "node " << i;
    }
  }

  Eigen::Vector3d middle() const
  {
    return simulation_->state().positions.topRows(5).colwise().mean();
  }

  static Eigen::Isometry3d pose(const Eigen::Vector3d& place, double angle)
  {
    return Eigen::Translation3d(place) * Eigen::Isometry3d(Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 2) / 3.0));
  }

  const Eigen::Isometry3d first_ = pose({ 0.2, -0.1, 1.4 }, 0.4);
  tf2::BufferCore transforms_;
  Frames frames_{ "world", transforms_ };
  PinAttachments attachments_{ { top_speed, max_age } };
  std::optional<Simulation> simulation_;
  Vectors held_;
  ros::Time now_{ 100.0 };
  double end_ = 0.0;
  std::string warnings_;
};

TEST_F(PinsOnAFrame, AreRigidlyWhereTheFrameHasThem)
{
  attachments_.attach("hand", "gripper", true);
  run_tick();
  expect_hand_at(Eigen::Isometry3d::Identity());
  for (int k = 1; k <= 10; ++k)
  {
    const Eigen::Isometry3d gripper = pose({ 0.2 + 0.03 * k, -0.1, 1.4 - 0.01 * k }, 0.4 + 0.05 * k);
    show(gripper);
    run_tick();
    expect_hand_at(gripper * first_.inverse());
    EXPECT_EQ(warnings_, "");
  }
}

TEST_F(PinsOnAFrame, WithoutTheirOffsetHaveTheirMiddleAtTheOriginAndTurn)
{
  attachments_.attach("hand", "gripper", false);
  for (int k = 0; k < 10; ++k)
  {
    run_tick();
    EXPECT_EQ(warnings_, "") << "the way to the frame is no jump of it";
  }
  EXPECT_LT((middle() - first_.translation()).norm(), 1e-12);
  const Eigen::Isometry3d gripper = pose({ 0.21, -0.1, 1.43 }, 0.5);
  show(gripper);
  run_tick();
  const Eigen::Vector3d held_middle = held_.colwise().mean();
  const Eigen::Isometry3d turn(Eigen::Matrix3d(gripper.linear() * first_.linear().transpose()));
  expect_hand_at(Eigen::Translation3d(gripper.translation()) * turn * Eigen::Translation3d(-held_middle));
}

TEST_F(PinsOnAFrame, FollowAJumpAtTheTopSpeedAndCatchUp)
{
  attachments_.attach("hand", "gripper", true);
  run_tick();
  const Eigen::Vector3d start = middle();
  show(Eigen::Translation3d(0.0, 0.75, 0.0) * first_);
  for (int k = 1; k <= 7; ++k)
  {
    run_tick();
    EXPECT_LT((middle() - start - Eigen::Vector3d(0.0, 0.1 * k, 0.0)).norm(), 1e-12) << "tick " << k;
    EXPECT_NEAR(simulation_->state().velocities(2, 1), top_speed, 1e-9);
    EXPECT_EQ(warnings_.empty(), k > 1) << warnings_;
  }
  run_tick();
  expect_hand_at(Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.75, 0.0)));
  EXPECT_NEAR(simulation_->state().velocities(2, 1), 1.5, 1e-9);
  show(first_);
  run_tick();
  EXPECT_EQ(warnings_, "frame 'gripper' jumped: the pin 'hand' follows it at tf_pins.top_speed, 3.0 m/s");
}

TEST_F(PinsOnAFrame, FollowAJumpOfTheTurnAtTheTopSpeedOfTheFastestNode)
{
  attachments_.attach("hand", "gripper", true);
  run_tick();
  const Eigen::Vector3d middle_at_start = middle();
  const Eigen::Isometry3d turn = Eigen::Translation3d(middle_at_start) *
                                 Eigen::Isometry3d(Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitZ())) *
                                 Eigen::Translation3d(-middle_at_start);
  show(turn * first_);
  run_tick();
  EXPECT_FALSE(warnings_.empty());
  const Eigen::Isometry3d begun =
      Eigen::Translation3d(middle_at_start) *
      Eigen::Isometry3d(Eigen::AngleAxisd(top_speed * tick / 0.5, Eigen::Vector3d::UnitZ())) *
      Eigen::Translation3d(-middle_at_start);
  expect_hand_at(begun);
  for (int k = 0; k < 8; ++k)
  {
    run_tick();
  }
  expect_hand_at(turn);
}

TEST_F(PinsOnAFrame, HoldTheirPlaceUntilTheFrameIsKnown)
{
  attachments_.attach("hand", "elsewhere", true);
  run_tick();
  EXPECT_EQ(warnings_, "the pin 'hand' holds its place: tf knows no transform from frame 'elsewhere' to 'world'");
  expect_hand_at(Eigen::Isometry3d::Identity());
  attachments_.attach("hand", "gripper", true);
  now_ += ros::Duration(0.2);
  const Eigen::Isometry3d seen_first = pose({ 5.0, 0.0, 0.0 }, 1.0);
  show(seen_first);
  run_tick();
  expect_hand_at(Eigen::Isometry3d::Identity());
  const Eigen::Isometry3d gripper = pose({ 5.0, 0.02, 0.0 }, 1.0);
  show(gripper);
  run_tick();
  expect_hand_at(gripper * seen_first.inverse());
}

TEST_F(PinsOnAFrame, HoldTheirPlaceWhileTheTransformIsTooOldAndGoOnAfterwards)
{
  attachments_.attach("hand", "gripper", true);
  run_tick();
  const Eigen::Isometry3d jump(Eigen::Translation3d(0.0, 0.15, 0.0));
  show(jump * first_);
  run_tick();
  const Vectors on_the_way = simulation_->state().positions.topRows(5);
  now_ += ros::Duration(max_age);
  run_tick();
  EXPECT_EQ(warnings_,
            "the pin 'hand' holds its place: the latest transform of frame 'gripper' is farther from now than "
            "tf_pins.max_age, 0.5 s");
  EXPECT_EQ(simulation_->state().positions.topRows(5), on_the_way);
  EXPECT_TRUE(simulation_->state().velocities.topRows(5).isZero(0.0));
  show(jump * first_);
  run_tick();
  expect_hand_at(jump);
}

TEST_F(PinsOnAFrame, HoldTheirPlaceWhenRosTimeJumpsBackUntilTheFrameIsSeenAgain)
{
  attachments_.attach("hand", "gripper", true);
  run_tick();
  now_ = ros::Time(20.0);
  run_tick();
  EXPECT_NE(warnings_.find("farther from now"), std::string::npos);
  const Eigen::Isometry3d shift(Eigen::Translation3d(0.0, 0.05, 0.0));
  show(shift * first_);
  run_tick();
  EXPECT_EQ(warnings_, "");
  expect_hand_at(shift);
}

TEST_F(PinsOnAFrame, GoByTransformsOfAnyAgeWhereNoAgeIsGiven)
{
  attachments_ = PinAttachments({ top_speed, 0.0 });
  attachments_.attach("hand", "gripper", true);
  run_tick();
  const Eigen::Isometry3d shift(Eigen::Translation3d(0.0, 0.05, 0.0));
  show(shift * first_);
  now_ += ros::Duration(1000.0);
  run_tick();
  expect_hand_at(shift);
}

TEST_F(PinsOnAFrame, StayWhenTheyAreDetachedAndAreForgottenWhenTheyAreReleased)
{
  const Eigen::Isometry3d shift(Eigen::Translation3d(0.0, 0.05, 0.0));
  attachments_.attach("hand", "gripper", true);
  run_tick();
  attachments_.detach("hand");
  show(shift * first_);
  run_tick();
  expect_hand_at(Eigen::Isometry3d::Identity());

  attachments_.attach("hand", "gripper", true);
  simulation_->release("hand");
  run_tick();
  simulation_->hold("hand", { 20, 21 });
  const Vectors lower_edge = simulation_->state().positions.row(20);
  show(first_);
  run_tick();
  EXPECT_EQ(simulation_->state().positions.row(20), lower_edge);
}

TEST_F(PinsOnAFrame, AreMadeByAMessageAndTakenOffTheFrameByAMove)
{
  cloth_sim::Pin request;
  request.action = cloth_sim::Pin::PIN;
  request.select = cloth_sim::Pin::NODE;
  request.name = "finger";
  request.row = 4;
  request.attach_frame = "gripper";
  request.keep_offset = 1;
  apply_pin(request, frames_, tick, *simulation_, attachments_);
  const Eigen::RowVector3d corner = simulation_->state().positions.row(20);
  run_tick();
  const Eigen::RowVector3d shift(0.0, 0.05, 0.0);
  show(Eigen::Translation3d(shift) * first_);
  run_tick();
  EXPECT_LT((simulation_->state().positions.row(20) - corner - shift).norm(), 1e-12);

  request.action = cloth_sim::Pin::MOVE;
  request.point.point.z = 0.6;
  apply_pin(request, frames_, tick, *simulation_, attachments_);
  run_tick();
  run_tick();
  EXPECT_LT((simulation_->state().positions.row(20) - Eigen::RowVector3d(0.0, 0.0, 0.6)).norm(), 1e-12);

  request.action = cloth_sim::Pin::PIN;
  apply_pin(request, frames_, tick, *simulation_, attachments_);
  request.attach_frame = "";
  apply_pin(request, frames_, tick, *simulation_, attachments_);
  show(first_);
  run_tick();
  EXPECT_LT((simulation_->state().positions.row(20) - Eigen::RowVector3d(0.0, 0.0, 0.6)).norm(), 1e-12);

  request.attach_frame = "/gripper";
  EXPECT_THROW(apply_pin(request, frames_, tick, *simulation_, attachments_), RefusedRequest);
}

}  // namespace
}  // namespace cloth
