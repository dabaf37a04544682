#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <gtest/gtest.h>
#include <tf2_ros/transform_broadcaster.h>

#include "cloth_sim/ClothState.h"

#include "listener.h"
#include "node_process.h"
#include "time_services.h"
#include "tuning_client.h"

namespace cloth
{
namespace
{

using diagnostic_msgs::DiagnosticArray;
using diagnostic_msgs::DiagnosticStatus;

/// The status of that name, or null.
const DiagnosticStatus* find(const DiagnosticArray& array, const std::string& name)
{
  for (const DiagnosticStatus& status : array.status)
  {
    if (status.name == "cloth_node: " + name)
    {
      return &status;
    }
  }
  return nullptr;
}

std::string value_in(const DiagnosticStatus& status, const std::string& key)
{
  for (const auto& value : status.values)
  {
    if (value.key == key)
    {
      return value.value;
    }
  }
  return "(no " + key + ")";
}

class HealthTest : public testing::Test
{
protected:
  /// Waits for a status with values, which those of the start do not have, that fulfils `condition`.
  bool wait_for_status(const std::string& name, const std::function<bool(const DiagnosticStatus&)>& condition)
  {
    return diagnostics_.wait_for_one([&](const DiagnosticArray& array) {
      const DiagnosticStatus* const status = find(array, name);
      return status != nullptr && !status->values.empty() && condition(*status);
    });
  }

  bool wait_for_level(const std::string& name, int level)
  {
    return wait_for_status(name, [=](const DiagnosticStatus& status) { return status.level == level; });
  }

  Listener<DiagnosticArray> diagnostics_{ "/diagnostics" };
  Listener<cloth_sim::ClothState> state_{ "/cloth_node/state" };
};

TEST_F(HealthTest, AGoodClothIsReportedWithItsFigures)
{
  NodeProcess node({ "_rate:=50", "_cloth/rows:=8", "_cloth/cols:=8", "_strain_limit/max_strain:=0.2" });
  ASSERT_TRUE(wait_for_level("cloth", DiagnosticStatus::OK));
  const DiagnosticStatus* const cloth = find(diagnostics_.last(), "cloth");
  EXPECT_EQ(value_in(*cloth, "strain limit"), "0.2");
  EXPECT_FALSE(value_in(*cloth, "method").empty());
  EXPECT_NE(value_in(*cloth, "method"), "auto");
  EXPECT_GT(std::stod(value_in(*cloth, "stability margin")), 1.0 / 0.9 - 0.05);
  EXPECT_LT(std::stod(value_in(*cloth, "stability margin")), 1.5) << "steps follow from a bound now and then";
  ASSERT_NE(find(diagnostics_.last(), "ticks"), nullptr);
  EXPECT_EQ(value_in(*find(diagnostics_.last(), "ticks"), "rate asked for (Hz)"), "50");
  ASSERT_NE(find(diagnostics_.last(), "transforms"), nullptr);
  EXPECT_EQ(find(diagnostics_.last(), "transforms")->message, "none used");
}

TEST_F(HealthTest, ADivergenceIsAnErrorUntilAReset)
{
  // The cloth diverges by itself once time goes on.
  NodeProcess node({ "_rate:=50", "_start_paused:=true", "_cloth/rows:=8", "_cloth/cols:=8", "_cloth/ripple:=0.02",
                     "_solver/time_step:=0.02", "_solver/method:=symplectic_euler", "_strain_limit/max_strain:=0",
                     "_springs/structural/stiffness:=5000" });
  ASSERT_TRUE(wait_for_level("cloth", DiagnosticStatus::WARN)) << "its step is beyond the stability limit";
  ASSERT_TRUE(set_paused(false).success);
  ASSERT_TRUE(wait_for_level("cloth", DiagnosticStatus::ERROR));
  const std::string cause = find(diagnostics_.last(), "cloth")->message;
  EXPECT_EQ(cause.find("diverged at"), 0u) << cause;
  EXPECT_NE(cause.find("take a smaller solver.time_step"), std::string::npos) << cause;
  ASSERT_TRUE(state_.wait_for_more(5)) << "the last good cloth is published on";

  ASSERT_TRUE(set_paused(true).success);
  ASSERT_TRUE(trigger("reset").success);
  EXPECT_TRUE(wait_for_level("cloth", DiagnosticStatus::WARN)) << "it has not diverged, but it will again";
}

TEST_F(HealthTest, AResetWithAStepThatIsSmallEnoughIsAllGood)
{
  NodeProcess node({ "_rate:=50", "_cloth/rows:=8", "_cloth/cols:=8", "_cloth/ripple:=0.02", "_solver/time_step:=0.02",
                     "_solver/method:=symplectic_euler", "_strain_limit/max_strain:=0",
                     "_springs/structural/stiffness:=5000" });
  ASSERT_TRUE(wait_for_level("cloth", DiagnosticStatus::ERROR));
  ASSERT_TRUE(Change().set("solver_time_step", 0.0).ask());
  ASSERT_TRUE(trigger("reset").success);
  EXPECT_TRUE(wait_for_level("cloth", DiagnosticStatus::OK));
}

TEST_F(HealthTest, DroppedTicksAreCountedAndWarnedOf)
{
  // No computer is as fast as that.
  NodeProcess node({ "_rate:=1000", "_real_time_factor:=100" });
  ASSERT_TRUE(wait_for_level("ticks", DiagnosticStatus::WARN));
  EXPECT_NE(value_in(*find(diagnostics_.last(), "ticks"), "overruns"), "0");
}

TEST_F(HealthTest, TheAgeOfATransformIsShown)
{
  ros::NodeHandle test;
  const ros::Publisher winds = test.advertise<geometry_msgs::Vector3Stamped>("/cloth_node/wind", 10);
  tf2_ros::TransformBroadcaster broadcaster;
  NodeProcess node({ "_rate:=50", "_cloth/rows:=8", "_cloth/cols:=8" });
  ASSERT_TRUE(wait_until([&] { return winds.getNumSubscribers() > 0; }));
  geometry_msgs::TransformStamped old;
  old.header.frame_id = "world";
  old.header.stamp = ros::Time::now() - ros::Duration(5.0);
  old.child_frame_id = "fan";
  old.transform.rotation.w = 1.0;
  geometry_msgs::Vector3Stamped wind;
  wind.header.frame_id = "fan";
  const auto blows_from_the_fan = [&] {
    return wait_until([&] {
      broadcaster.sendTransform(old);
      winds.publish(wind);
      return !diagnostics_.all().empty() && find(diagnostics_.last(), "transforms") != nullptr &&
             find(diagnostics_.last(), "transforms")->level == DiagnosticStatus::WARN;
    });
  };
  ASSERT_TRUE(blows_from_the_fan());
  EXPECT_EQ(value_in(*find(diagnostics_.last(), "transforms"), "frame"), "fan");
  EXPECT_GE(std::stod(value_in(*find(diagnostics_.last(), "transforms"), "tf age (s)")), 5.0);
}

}  // namespace
}  // namespace cloth
