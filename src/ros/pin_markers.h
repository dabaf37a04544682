#pragma once

#include <string>
#include <vector>

#include <ros/time.h>
#include <visualization_msgs/MarkerArray.h>

#include "cloth_sim/constraints/pins.h"
#include "cloth_sim/model/cloth_model.h"

namespace cloth
{

/// The pins for rviz: one SPHERE_LIST each, its namespace the pin's name, a sphere a node. Every array shows all pins,
/// and deletes those that the last one showed and that are gone.
class PinMarkers
{
public:
  PinMarkers(const ClothModel& model, const std::string& frame_id);

  /// The markers at the nodes' `positions` (m); null when nothing changed since the last call.
  visualization_msgs::MarkerArray::ConstPtr update(const std::vector<Pin>& pins, const Vectors& positions,
                                                   const ros::Time& stamp);

private:
  bool shows(const std::vector<Pin>& pins, const Vectors& positions) const;
  visualization_msgs::Marker marker_of(const Pin& pin, const Vectors& positions, const ros::Time& stamp) const;

  std::string frame_id_;
  double diameter_;  ///< m
  bool shown_before_ = false;
  std::vector<visualization_msgs::Marker> shown_;  ///< one a pin, in the order of the pins
};

}  // namespace cloth
