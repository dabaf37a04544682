#pragma once

#include <string>

#include <ros/time.h>
#include <visualization_msgs/Marker.h>

#include "cloth_sim/model/cloth_model.h"

#include "reused_messages.h"

namespace cloth
{

/// All springs as one LINE_LIST for rviz, coloured by kind. Takes its memory with the first call of `update`.
class SpringMarker
{
public:
  /// `model` must outlive this object.
  SpringMarker(const ClothModel& model, const std::string& frame_id);

  /// The marker of the nodes' `positions` (m, finite). Whoever holds it keeps it as it is.
  visualization_msgs::Marker::ConstPtr update(const Vectors& positions, const ros::Time& stamp);

private:
  const ClothModel& model_;
  ReusedMessages<visualization_msgs::Marker> markers_;
};

}  // namespace cloth
