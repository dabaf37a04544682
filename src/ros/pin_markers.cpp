#include "pin_markers.h"

#include <algorithm>

#include <boost/make_shared.hpp>

#include "conversions.h"
#include "new_marker.h"

namespace cloth
{

PinMarkers::PinMarkers(const ClothModel& model, const std::string& frame_id)
  : frame_id_(frame_id), diameter_(0.02 * std::max(model.width, model.height))
{
}

visualization_msgs::MarkerArray::ConstPtr PinMarkers::update(const std::vector<Pin>& pins, const Vectors& positions,
                                                             const ros::Time& stamp)
{
  if (shown_before_ && shows(pins, positions))
  {
    return nullptr;
  }
  const auto message = boost::make_shared<visualization_msgs::MarkerArray>();
  for (visualization_msgs::Marker& old : shown_)
  {
    const bool stays = std::any_of(pins.begin(), pins.end(), [&](const Pin& pin) { return pin.name == old.ns; });
    if (!stays)
    {
      old.header.stamp = stamp;
      old.action = visualization_msgs::Marker::DELETE;
      old.points.clear();
      message->markers.push_back(old);
    }
  }
  shown_.clear();
  for (const Pin& pin : pins)
  {
    shown_.push_back(marker_of(pin, positions, stamp));
  }
  message->markers.insert(message->markers.end(), shown_.begin(), shown_.end());
  shown_before_ = true;
  return message;
}

bool PinMarkers::shows(const std::vector<Pin>& pins, const Vectors& positions) const
{
  const auto shows_pin = [&](const visualization_msgs::Marker& marker, const Pin& pin) {
    const auto shows_node = [&](const geometry_msgs::Point& point, int node) {
      return point == to_point(positions, node);
    };
    return marker.ns == pin.name &&
           std::equal(marker.points.begin(), marker.points.end(), pin.nodes.begin(), pin.nodes.end(), shows_node);
  };
  return std::equal(shown_.begin(), shown_.end(), pins.begin(), pins.end(), shows_pin);
}

visualization_msgs::Marker PinMarkers::marker_of(const Pin& pin, const Vectors& positions, const ros::Time& stamp) const
{
  visualization_msgs::Marker marker = new_marker(frame_id_, pin.name, visualization_msgs::Marker::SPHERE_LIST);
  marker.header.stamp = stamp;
  marker.scale.x = marker.scale.y = marker.scale.z = diameter_;
  marker.color = to_colour({ 0.98, 0.80, 0.25 });
  for (const int node : pin.nodes)
  {
    marker.points.push_back(to_point(positions, node));
  }
  return marker;
}

}  // namespace cloth
