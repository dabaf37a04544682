#include "tick_clock.h"

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

const ros::Time start(100.0);

ros::Time after(double seconds)
{
  return start + ros::Duration(seconds);
}

TEST(TickClock, ComesOncePerPeriod)
{
  TickClock clock(10.0, 1.0);
  EXPECT_FALSE(clock.take(start));
  EXPECT_FALSE(clock.take(after(0.099)));
  const auto tick = clock.take(after(0.12));
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->stamp, after(0.1));
  EXPECT_EQ(tick->simulated_time, 0.1);
  EXPECT_FALSE(clock.take(after(0.199)));
  EXPECT_TRUE(clock.take(after(0.2)));
}

TEST(TickClock, SimulatesFasterOrSlowerThanRosTime)
{
  TickClock fast(10.0, 5.0);
  fast.take(start);
  EXPECT_DOUBLE_EQ(fast.take(after(0.1))->simulated_time, 0.5);
  EXPECT_DOUBLE_EQ(fast.simulated_period(), 0.5);
  TickClock slow(10.0, 0.1);
  slow.take(start);
  EXPECT_DOUBLE_EQ(slow.take(after(0.1))->simulated_time, 0.01);
}

TEST(TickClock, WithoutAFactorTheNextTickIsDueAtOnce)
{
  TickClock clock(10.0, 0.0);
  EXPECT_DOUBLE_EQ(clock.take(start)->simulated_time, 0.1);
  EXPECT_DOUBLE_EQ(clock.take(start)->simulated_time, 0.2);
  EXPECT_EQ(clock.take(after(3.0))->stamp, after(3.0));
  EXPECT_EQ(clock.overruns(), 0u);
}

TEST(TickClock, RoundingErrorsDoNotBuildUp)
{
  TickClock clock(30.0, 1.0);
  clock.take(start);
  Tick tick;
  for (int i = 1; i <= 30000; ++i)
  {
    tick = *clock.take(after(i / 30.0 + 1e-6));
  }
  EXPECT_EQ(tick.simulated_time, 1000.0);
  EXPECT_EQ(tick.stamp, after(1000.0));
}

TEST(TickClock, NothingIsDueBeforeThereIsATime)
{
  TickClock clock(10.0, 1.0);
  EXPECT_FALSE(clock.take(ros::Time()));
  EXPECT_FALSE(clock.take(start));
  EXPECT_FALSE(clock.take(start));
  EXPECT_TRUE(clock.take(after(0.1)));
}

TEST(TickClock, CatchesUpWhatIsNotTooFarBack)
{
  TickClock clock(10.0, 1.0);
  clock.take(start);
  for (int i = 1; i <= 4; ++i)
  {
    EXPECT_EQ(clock.take(after(0.45))->stamp, after(0.1 * i));
  }
  EXPECT_FALSE(clock.take(after(0.45)));
  EXPECT_EQ(clock.overruns(), 0u);
}

TEST(TickClock, DropsAndCountsWhatIsTooFarBack)
{
  TickClock clock(10.0, 1.0);
  clock.take(start);
  int ticks = 0;
  Tick last;
  while (const auto tick = clock.take(after(10.05)))
  {
    last = *tick;
    ++ticks;
  }
  EXPECT_EQ(ticks, 5);
  EXPECT_EQ(clock.overruns(), 95u);
  EXPECT_EQ(last.stamp, after(10.0));
  EXPECT_DOUBLE_EQ(last.simulated_time, 0.5);
}

TEST(TickClock, GoesOnFromWhereTimeJumpsBackTo)
{
  TickClock clock(10.0, 1.0);
  clock.take(start);
  clock.take(after(0.1));
  EXPECT_FALSE(clock.take(after(-50.0)));
  const auto tick = clock.take(after(-49.9));
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->stamp, after(-49.9));
  EXPECT_DOUBLE_EQ(tick->simulated_time, 0.2);
  EXPECT_EQ(clock.overruns(), 0u);
}

TEST(TickClock, StepsWhenTold)
{
  TickClock clock(10.0, 2.0);
  clock.take(start);
  const Tick tick = clock.step(after(0.03));
  EXPECT_EQ(tick.stamp, after(0.03));
  EXPECT_DOUBLE_EQ(tick.simulated_time, 0.2);
  EXPECT_DOUBLE_EQ(clock.step(after(0.03)).simulated_time, 0.4);
  EXPECT_DOUBLE_EQ(TickClock(10.0, 0.0).step(ros::Time()).simulated_time, 0.1);
}

TEST(TickClock, AnInterruptionIsNeitherCaughtUpNorCounted)
{
  TickClock clock(10.0, 1.0);
  clock.take(start);
  clock.take(after(0.1));
  clock.interrupt();
  EXPECT_FALSE(clock.take(after(50.03)));
  EXPECT_FALSE(clock.take(after(50.12)));
  const auto tick = clock.take(after(50.13));
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->stamp, after(50.13));
  EXPECT_DOUBLE_EQ(tick->simulated_time, 0.2);
  EXPECT_EQ(clock.overruns(), 0u);
}

TEST(TickClock, SaysHowLongToWait)
{
  TickClock clock(10.0, 1.0);
  clock.take(start);
  EXPECT_NEAR(clock.until_next(after(0.03)).toSec(), 0.07, 1e-9);
  EXPECT_EQ(clock.until_next(after(0.2)).toSec(), 0.0);
}

TEST(TickClock, AnotherPaceGoesOnFromTheLastTick)
{
  TickClock clock(10.0, 1.0);
  clock.take(start);
  ASSERT_TRUE(clock.take(after(0.1)));
  EXPECT_FALSE(clock.take(after(0.11)));
  clock.set_pace(50.0, 2.0);
  EXPECT_EQ(clock.until_next(after(0.11)), ros::Duration(0.01));
  const auto tick = clock.take(after(0.12));
  ASSERT_TRUE(tick);
  EXPECT_EQ(tick->stamp, after(0.12));
  EXPECT_DOUBLE_EQ(tick->simulated_time, 0.14);
  EXPECT_FALSE(clock.take(after(0.139)));
  EXPECT_EQ(clock.overruns(), 0u);
}

TEST(TickClock, AfterALongPeriodAShortOneIsNoBacklog)
{
  TickClock clock(0.001, 1.0);
  clock.take(start);
  EXPECT_FALSE(clock.take(after(900.0)));
  clock.set_pace(100.0, 1.0);
  EXPECT_TRUE(clock.take(after(900.0)));
  EXPECT_FALSE(clock.take(after(900.005)));
  EXPECT_EQ(clock.overruns(), 0u);
}

TEST(TickClock, ABacklogOutlastsAnotherPace)
{
  TickClock clock(10.0, 1.0);
  clock.take(start);
  ASSERT_TRUE(clock.take(after(0.3)));
  clock.set_pace(20.0, 1.0);
  for (const double due : { 0.15, 0.2, 0.25, 0.3 })
  {
    const auto tick = clock.take(after(0.3));
    ASSERT_TRUE(tick) << due;
    EXPECT_EQ(tick->stamp, after(due));
  }
  EXPECT_FALSE(clock.take(after(0.3)));
}

TEST(TickClock, AnotherPaceBeforeTheFirstTimeAndFromAsFastAsItCan)
{
  TickClock clock(10.0, 0.0);
  clock.set_pace(20.0, 0.0);
  EXPECT_DOUBLE_EQ(clock.take(start)->simulated_time, 0.05);
  clock.set_pace(20.0, 1.0);
  EXPECT_FALSE(clock.take(after(0.01)));
  EXPECT_DOUBLE_EQ(clock.take(after(0.05))->simulated_time, 0.1);
}

}  // namespace
}  // namespace cloth
