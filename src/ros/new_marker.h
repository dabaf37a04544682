#pragma once

#include <cstdint>
#include <string>

#include <visualization_msgs/Marker.h>

namespace cloth
{

/// A marker to be added, placed at the origin of `frame_id`; its number within `ns` is 0. It has no size, colour and
/// points yet.
visualization_msgs::Marker new_marker(const std::string& frame_id, const std::string& ns, std::int32_t type);

}  // namespace cloth
