#include "pin_handles.h"

#include <algorithm>
#include <utility>

#include <visualization_msgs/InteractiveMarker.h>
#include <visualization_msgs/InteractiveMarkerControl.h>
#include <visualization_msgs/MenuEntry.h>

#include "conversions.h"

namespace cloth
{
namespace
{

using visualization_msgs::InteractiveMarker;
using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::Marker;
using visualization_msgs::MenuEntry;

constexpr std::uint32_t release_entry = 1;
constexpr std::uint32_t release_all_entry = 2;

MenuEntry menu_entry(std::uint32_t id, const std::string& title)
{
  MenuEntry entry;
  entry.id = id;
  entry.title = title;
  entry.command_type = MenuEntry::FEEDBACK;
  return entry;
}

Marker ball(double diameter)
{
  Marker marker;
  marker.type = Marker::SPHERE;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = diameter;
  marker.color = to_colour({ 0.98, 0.80, 0.25 });
  marker.color.a = 0.35F;  // the pin's nodes show through
  return marker;
}

/// Moves in the plane of the view; in rviz with Shift along the view.
InteractiveMarkerControl drag_control(double diameter)
{
  InteractiveMarkerControl control;
  control.name = "drag";
  control.interaction_mode = InteractiveMarkerControl::MOVE_3D;
  control.orientation.w = 1.0;
  control.markers.push_back(ball(diameter));
  return control;
}

geometry_msgs::Pose pose_at(const Eigen::Vector3d& place)
{
  geometry_msgs::Pose pose;
  pose.position.x = place.x();
  pose.position.y = place.y();
  pose.position.z = place.z();
  pose.orientation.w = 1.0;
  return pose;
}

cloth_sim::Pin move_request(const visualization_msgs::InteractiveMarkerFeedback& feedback)
{
  cloth_sim::Pin request;
  request.action = cloth_sim::Pin::MOVE;
  request.name = feedback.marker_name;
  request.point.header = feedback.header;
  request.point.point = feedback.pose.position;
  return request;
}

cloth_sim::Pin release_request(const std::string& name)
{
  cloth_sim::Pin request;
  request.action = cloth_sim::Pin::RELEASE;
  request.name = name;
  return request;
}

}  // namespace

PinHandles::PinHandles(const std::string& topics, Listener listener) : listener_(std::move(listener)), server_(topics)
{
}

std::optional<cloth_sim::Pin> PinHandles::take(const Feedback& feedback, Clock::time_point now)
{
  switch (feedback.event_type)
  {
    case Feedback::MOUSE_DOWN:
      dragged_[feedback.marker_name] = now;
      return {};
    case Feedback::POSE_UPDATE:
      dragged_[feedback.marker_name] = now;
      return move_request(feedback);
    case Feedback::KEEP_ALIVE:
      if (dragged_.count(feedback.marker_name) > 0)
      {
        dragged_[feedback.marker_name] = now;
      }
      return {};
    case Feedback::MOUSE_UP:
      end_drag(feedback.marker_name);
      return {};
    case Feedback::MENU_SELECT:
      return release_request(feedback.menu_entry_id == release_all_entry ? "" : feedback.marker_name);
    default:
      return {};
  }
}

void PinHandles::show(const std::vector<Pin>& pins, double time, const Style& style, Clock::time_point now)
{
  end_silent_drags(now);
  erase_all_but(pins);
  for (const Pin& pin : pins)
  {
    const Eigen::Vector3d place = pin.middle(std::max(time, pin.carry.end));
    const auto shown = shown_.find(pin.name);
    if (shown == shown_.end())
    {
      insert(pin.name, place, style);
    }
    else if (shown->second != place && dragged_.count(pin.name) == 0)
    {
      server_.setPose(pin.name, pose_at(place));
      shown->second = place;
    }
  }
  server_.applyChanges();  // publishes nothing where nothing changed
}

void PinHandles::clear()
{
  erase_all_but({});
  server_.applyChanges();
}

void PinHandles::erase_all_but(const std::vector<Pin>& pins)
{
  for (auto shown = shown_.begin(); shown != shown_.end();)
  {
    const std::string name = shown->first;
    const bool stays = std::any_of(pins.begin(), pins.end(), [&](const Pin& pin) { return pin.name == name; });
    if (stays)
    {
      ++shown;
      continue;
    }
    server_.erase(name);
    dragged_.erase(name);
    shown = shown_.erase(shown);
  }
}

void PinHandles::end_silent_drags(Clock::time_point now)
{
  std::vector<std::string> silent;
  for (const auto& [name, heard] : dragged_)
  {
    if (now - heard > longest_silence)
    {
      silent.push_back(name);
    }
  }
  for (const std::string& name : silent)
  {
    end_drag(name);
  }
}

void PinHandles::end_drag(const std::string& name)
{
  dragged_.erase(name);
  const auto shown = shown_.find(name);
  if (shown != shown_.end())
  {
    shown->second.reset();
  }
}

void PinHandles::insert(const std::string& name, const Eigen::Vector3d& place, const Style& style)
{
  InteractiveMarker marker;
  marker.header.frame_id = style.frame_id;
  marker.name = name;
  marker.description = name;
  marker.scale = static_cast<float>(style.diameter);
  marker.pose = pose_at(place);
  marker.menu_entries = { menu_entry(release_entry, "release"), menu_entry(release_all_entry, "release all") };
  marker.controls.push_back(drag_control(style.diameter));
  server_.insert(marker, [this](const Feedback::ConstPtr& feedback) { listener_(feedback); });
  shown_[name] = place;
}

}  // namespace cloth
