#include "tick_statistics.h"

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

using std::chrono::milliseconds;

const TickStatistics::Clock::time_point start{};

TEST(TickStatistics, SumsUpAPeriod)
{
  TickStatistics statistics(start);
  statistics.add(milliseconds(2));
  statistics.add(milliseconds(6));
  EXPECT_FALSE(statistics.due(start + milliseconds(999)));
  EXPECT_TRUE(statistics.due(start + milliseconds(1000)));
  const TickReport report = statistics.take(start + milliseconds(2000), 3.0);
  EXPECT_DOUBLE_EQ(report.tick_ms_mean, 4.0);
  EXPECT_DOUBLE_EQ(report.tick_ms_max, 6.0);
  EXPECT_DOUBLE_EQ(report.real_time_factor, 1.5);
  EXPECT_DOUBLE_EQ(report.rate, 1.0);
}

TEST(TickStatistics, BeginsAnewAfterwards)
{
  TickStatistics statistics(start);
  statistics.add(milliseconds(9));
  statistics.take(start + milliseconds(1000), 4.0);
  EXPECT_FALSE(statistics.due(start + milliseconds(1999)));
  const TickReport report = statistics.take(start + milliseconds(2000), 4.5);
  EXPECT_EQ(report.tick_ms_mean, 0.0);
  EXPECT_EQ(report.tick_ms_max, 0.0);
  EXPECT_DOUBLE_EQ(report.real_time_factor, 0.5);
}

TEST(TickStatistics, SimulatedTimeMayBeginAgain)
{
  TickStatistics statistics(start);
  statistics.take(start + milliseconds(1000), 4.0);
  statistics.restart(4.5);
  EXPECT_DOUBLE_EQ(statistics.take(start + milliseconds(2000), 0.25).real_time_factor, 0.75);
}

}  // namespace
}  // namespace cloth
