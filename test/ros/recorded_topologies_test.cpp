#include "recorded_topologies.h"

#include <boost/make_shared.hpp>
#include <gtest/gtest.h>

namespace cloth
{
namespace
{

using cloth_sim::ClothTopology;

ClothTopology::ConstPtr topology(std::uint32_t version, double stamp, std::uint32_t rows = 2)
{
  const auto message = boost::make_shared<ClothTopology>();
  message->version = version;
  message->header.stamp = ros::Time(stamp);
  message->rows = rows;
  return message;
}

TEST(RecordedTopologies, OfOneVersionTheLastBeforeTheStateIsTaken)
{
  const auto early = topology(1, 10.0);
  const auto late = topology(1, 20.0);
  const auto second = topology(2, 15.0);
  RecordedTopologies topologies;
  for (const auto& each : { late, second, early })
  {
    topologies.add(each);
  }
  EXPECT_EQ(topologies.find(1, ros::Time(10.0)), early);
  EXPECT_EQ(topologies.find(1, ros::Time(19.0)), early);
  EXPECT_EQ(topologies.find(1, ros::Time(25.0)), late);
  EXPECT_EQ(topologies.find(1, ros::Time(5.0)), early);
  EXPECT_EQ(topologies.find(2, ros::Time(10.0)), second);
  EXPECT_EQ(topologies.find(3, ros::Time(10.0)), nullptr);
  EXPECT_EQ(topologies.find(0, ros::Time(10.0)), nullptr);
}

TEST(RecordedTopologies, OneThatComesAgainIsStillTheSame)
{
  const auto once = topology(1, 10.0);
  RecordedTopologies topologies;
  topologies.add(once);
  topologies.add(topology(1, 10.0));
  EXPECT_EQ(topologies.find(1, ros::Time(11.0)), once);
  const auto other = topology(1, 10.0, 3);
  topologies.add(other);
  EXPECT_EQ(topologies.find(1, ros::Time(11.0)), other);
}

}  // namespace
}  // namespace cloth
