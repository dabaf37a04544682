#pragma once

#include <cmath>

#include <geometry_msgs/TransformStamped.h>
#include <tf2_ros/static_transform_broadcaster.h>

namespace cloth
{

/// Makes the frame `gripper` known, for good: half a metre in front of the middle of a sheet that hangs from 1.5 m, its
/// x axis along the world's y.
inline void broadcast_gripper()
{
  static tf2_ros::StaticTransformBroadcaster broadcaster;
  geometry_msgs::TransformStamped gripper;
  gripper.header.frame_id = "world";
  gripper.child_frame_id = "gripper";
  gripper.transform.translation.y = 0.5;
  gripper.transform.translation.z = 1.0;
  gripper.transform.rotation.z = gripper.transform.rotation.w = std::sqrt(0.5);
  broadcaster.sendTransform(gripper);
}

}  // namespace cloth
