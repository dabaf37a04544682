#pragma once

#include <optional>

#include <ros/time.h>

namespace cloth
{

/// Says when wind that came by topic has had its time. Reads no clock itself: every call is told the ROS time.
class WindTimeOut
{
public:
  /// So long after the last message, s; 0: never.
  explicit WindTimeOut(double seconds);

  /// A message came.
  void restart(const ros::Time& now);
  /// True once, when so much time has passed. Where ROS time began or jumped backwards meanwhile, it counts from there.
  bool is_over(const ros::Time& now);

private:
  double seconds_;
  std::optional<ros::Time> since_;
};

}  // namespace cloth
