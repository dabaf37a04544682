#include "new_marker.h"

namespace cloth
{

visualization_msgs::Marker new_marker(const std::string& frame_id, const std::string& ns, std::int32_t type)
{
  visualization_msgs::Marker marker;
  marker.header.frame_id = frame_id;
  marker.ns = ns;
  marker.type = type;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  return marker;
}

}  // namespace cloth
