#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>

namespace cloth
{

/// Makes the ROS time: the one publisher of /clock. Latched, so that nodes that come while time stands have it too.
class ClockPublisher
{
public:
  /// Publishes the wall time, from which ROS time goes on: a node that is started again does not take it back. Throws
  /// SceneError where /use_sim_time is not true, or /clock has a publisher.
  ClockPublisher();

  /// The ROS time as it was published last.
  const ros::Time& time() const
  {
    return time_;
  }

  void publish(const ros::Time& time);

private:
  ros::NodeHandle node_;
  ros::Publisher clock_;
  ros::Time time_;
};

}  // namespace cloth
