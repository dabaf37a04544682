#include "health.h"

#include <limits>
#include <map>

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

Condition good()
{
  Condition condition;
  condition.stats.max_strain = 0.05;
  condition.stats.time_step = 1e-3;
  condition.stats.stability_limit = 1.25e-3;
  condition.stats.method = "velocity_verlet";
  condition.stats.real_time_factor = 0.98;
  condition.tick_rate = 29.5;
  condition.strain_limit = 0.1;
  return condition;
}

template <typename Report>
DiagnosticStatusWrapper status_of(Report report, const Condition& condition)
{
  DiagnosticStatusWrapper status;
  report(condition, status);
  return status;
}

std::map<std::string, std::string> values_of(const DiagnosticStatusWrapper& status)
{
  std::map<std::string, std::string> values;
  for (const auto& value : status.values)
  {
    values[value.key] = value.value;
  }
  return values;
}

TEST(HealthOfTicks, IsGoodWhereNoneIsDropped)
{
  Condition condition = good();
  condition.stats.overruns = 7;
  const auto status = status_of(report_ticks, condition);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  EXPECT_EQ(status.message, "29.5 ticks a second");
  auto values = values_of(status);
  EXPECT_EQ(values["rate asked for (Hz)"], "30");
  EXPECT_EQ(values["real-time factor"], "0.98");
  EXPECT_EQ(values["overruns"], "7");
  condition.stats.paused = 1;
  EXPECT_EQ(status_of(report_ticks, condition).message, "paused");
}

TEST(HealthOfTicks, WarnsOfDroppedOnes)
{
  Condition condition = good();
  condition.new_overruns = 4;
  const auto status = status_of(report_ticks, condition);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(status.message, "4 ticks dropped: too slow");
}

TEST(HealthOfTicks, WarnsOfOneThatDoesNotEnd)
{
  Condition condition = good();
  condition.tick_under_way = 12.0;
  const auto status = status_of(report_ticks, condition);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(status.message, "a tick has taken 12 s so far");
}

TEST(HealthOfTheCloth, IsGoodWithinItsLimits)
{
  const auto status = status_of(report_cloth, good());
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  EXPECT_EQ(status.message, "strain 0.05 of 0.1");
  auto values = values_of(status);
  EXPECT_EQ(values["worst strain"], "0.05");
  EXPECT_EQ(values["strain limit"], "0.1");
  EXPECT_EQ(values["stability margin"], "1.25");
  EXPECT_EQ(values["asleep since (s)"], "awake");
}

TEST(HealthOfTheCloth, SaysSinceWhenItSleeps)
{
  Condition condition = good();
  condition.asleep_since = 2.5;
  const auto status = status_of(report_cloth, condition);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  EXPECT_EQ(values_of(status)["asleep since (s)"], "2.5");
}

TEST(HealthOfTheCloth, NeedsNoLimits)
{
  Condition condition = good();
  condition.strain_limit = 0.0;
  condition.stats.stability_limit = std::numeric_limits<double>::infinity();
  const auto status = status_of(report_cloth, condition);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  auto values = values_of(status);
  EXPECT_EQ(values["strain limit"], "none");
  EXPECT_EQ(values["stability limit (s)"], ".inf");
}

TEST(HealthOfTheCloth, WarnsOfAStepBeyondTheLimit)
{
  Condition condition = good();
  condition.stats.time_step = 2e-3;
  EXPECT_EQ(status_of(report_cloth, condition).level, DiagnosticStatus::WARN);
  condition.stats.method = "dopri5";
  EXPECT_EQ(status_of(report_cloth, condition).level, DiagnosticStatus::OK) << "it rejects such steps";
}

TEST(HealthOfTheCloth, WarnsOfStrainFarAboveTheLimit)
{
  Condition condition = good();
  condition.stats.max_strain = 0.2;
  const auto status = status_of(report_cloth, condition);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(status.message.find("strain 0.2 of 0.1"), 0u);
}

TEST(HealthOfTheCloth, ADivergenceIsAnErrorWithItsCause)
{
  Condition condition = good();
  condition.divergence = "diverged at 0.4 s";
  const auto status = status_of(report_cloth, condition);
  EXPECT_EQ(status.level, DiagnosticStatus::ERROR);
  EXPECT_EQ(status.message, "diverged at 0.4 s");
}

TEST(HealthOfTransforms, TellsTheAgeOfTheOneUsedLast)
{
  Condition condition = good();
  EXPECT_EQ(status_of(report_transforms, condition).message, "none used");
  condition.transform = Frames::Use{ "gripper", std::nullopt };
  EXPECT_EQ(status_of(report_transforms, condition).message, "from gripper: static");
  condition.transform->age = 0.02;
  auto status = status_of(report_transforms, condition);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  EXPECT_EQ(values_of(status)["tf age (s)"], "0.02");
  condition.transform->age = 3.0;
  status = status_of(report_transforms, condition);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(status.message, "from gripper: 3 s old");
}

}  // namespace
}  // namespace cloth
