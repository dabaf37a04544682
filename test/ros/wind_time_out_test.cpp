#include "wind_time_out.h"

#include <gtest/gtest.h>

namespace cloth
{
namespace
{

TEST(WindTimeOut, IsOverOnceTheTimeHasPassedSinceTheLastMessage)
{
  WindTimeOut time_out(0.5);
  EXPECT_FALSE(time_out.is_over(ros::Time(1000.0))) << "no wind came";
  time_out.restart(ros::Time(1000.0));
  EXPECT_FALSE(time_out.is_over(ros::Time(1000.4)));
  time_out.restart(ros::Time(1000.4));
  EXPECT_FALSE(time_out.is_over(ros::Time(1000.8)));
  EXPECT_TRUE(time_out.is_over(ros::Time(1000.95)));
  EXPECT_FALSE(time_out.is_over(ros::Time(2000.0))) << "it has been over before";
  time_out.restart(ros::Time(2000.0));
  EXPECT_TRUE(time_out.is_over(ros::Time(2001.0)));
}

TEST(WindTimeOut, CountsFromWhereTheClockBeganOrJumpedBackTo)
{
  WindTimeOut time_out(0.5);
  time_out.restart(ros::Time());
  EXPECT_FALSE(time_out.is_over(ros::Time()));
  EXPECT_FALSE(time_out.is_over(ros::Time(1000.0)));
  EXPECT_FALSE(time_out.is_over(ros::Time(10.0)));
  EXPECT_FALSE(time_out.is_over(ros::Time(10.4)));
  EXPECT_TRUE(time_out.is_over(ros::Time(10.6)));
}

TEST(WindTimeOut, OfZeroIsNeverOver)
{
  WindTimeOut time_out(0.0);
  time_out.restart(ros::Time(1000.0));
  EXPECT_FALSE(time_out.is_over(ros::Time(9000.0)));
}

}  // namespace
}  // namespace cloth
