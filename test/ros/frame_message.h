#pragma once

#include <string>

#include <Eigen/Geometry>
#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>

namespace cloth
{

/// For tf: at `stamp` the frame `name` is at `place` in the frame `world`.
inline geometry_msgs::TransformStamped frame_message(const std::string& name, const Eigen::Isometry3d& place,
                                                     const ros::Time& stamp)
{
  geometry_msgs::TransformStamped message;
  message.header.frame_id = "world";
  message.header.stamp = stamp;
  message.child_frame_id = name;
  message.transform.translation.x = place.translation().x();
  message.transform.translation.y = place.translation().y();
  message.transform.translation.z = place.translation().z();
  const Eigen::Quaterniond turn(place.linear());
  message.transform.rotation.w = turn.w();
  message.transform.rotation.x = turn.x();
  message.transform.rotation.y = turn.y();
  message.transform.rotation.z = turn.z();
  return message;
}

}  // namespace cloth
