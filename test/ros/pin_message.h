#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

#include "cloth_sim/Pin.h"

namespace cloth
{

inline cloth_sim::Pin pin_node(const std::string& name, std::uint32_t row, std::uint32_t col)
{
  cloth_sim::Pin message;
  message.action = cloth_sim::Pin::PIN;
  message.select = cloth_sim::Pin::NODE;
  message.name = name;
  message.row = row;
  message.col = col;
  return message;
}

/// Carried by `frame`.
inline cloth_sim::Pin attach_node(const std::string& name, std::uint32_t row, std::uint32_t col,
                                  const std::string& frame, bool keep_offset)
{
  cloth_sim::Pin message = pin_node(name, row, col);
  message.attach_frame = frame;
  message.keep_offset = static_cast<std::uint8_t>(keep_offset);
  return message;
}

/// An empty name: all.
inline cloth_sim::Pin release_pin(const std::string& name)
{
  cloth_sim::Pin message;
  message.action = cloth_sim::Pin::RELEASE;
  message.name = name;
  return message;
}

inline cloth_sim::Pin move_pin(const std::string& name, const Eigen::Vector3d& point, const std::string& frame = "")
{
  cloth_sim::Pin message;
  message.action = cloth_sim::Pin::MOVE;
  message.name = name;
  message.point.header.frame_id = frame;
  message.point.point.x = point.x();
  message.point.point.y = point.y();
  message.point.point.z = point.z();
  return message;
}

inline cloth_sim::Pin pin_nearest(const std::string& name, const Eigen::Vector3d& point, const std::string& frame = "")
{
  cloth_sim::Pin message = move_pin(name, point, frame);
  message.action = cloth_sim::Pin::PIN;
  message.select = cloth_sim::Pin::NEAREST;
  return message;
}

/// All within `radius` (m) of the point.
inline cloth_sim::Pin pin_within(const std::string& name, const Eigen::Vector3d& point, double radius)
{
  cloth_sim::Pin message = pin_nearest(name, point);
  message.select = cloth_sim::Pin::RADIUS;
  message.radius = radius;
  return message;
}

}  // namespace cloth
