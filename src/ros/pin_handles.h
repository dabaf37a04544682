#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <interactive_markers/interactive_marker_server.h>
#include <visualization_msgs/InteractiveMarkerFeedback.h>

#include "cloth_sim/Pin.h"
#include "cloth_sim/constraints/pins.h"

namespace cloth
{

/// The pins as interactive markers, called as their pins: dragging one moves the pin, its menu releases it. All but the
/// listener is for one thread alone.
class PinHandles
{
public:
  using Clock = std::chrono::steady_clock;
  using Feedback = visualization_msgs::InteractiveMarkerFeedback;
  using Listener = std::function<void(const Feedback::ConstPtr&)>;
  /// A drag that is not heard of for so long is over: its rviz is gone. A living one sends four signs a second.
  static constexpr std::chrono::seconds longest_silence{ 1 };

  /// How the handles look.
  struct Style
  {
    std::string frame_id;
    double diameter = 0.0;  ///< m
  };

  /// `listener` gets what users do, in a callback's thread, for `take` to be called with in the thread of this object.
  PinHandles(const std::string& topics, Listener listener);

  /// Takes note of what a user did; the request that follows from it, if one does.
  std::optional<cloth_sim::Pin> take(const Feedback& feedback, Clock::time_point now = Clock::now());

  /// A handle for each pin, at the place where its middle is at `time` (s) or is on the way to; one that is being
  /// dragged stays with the mouse. Nothing is published when nothing changed.
  void show(const std::vector<Pin>& pins, double time, const Style& style, Clock::time_point now = Clock::now());
  void clear();

private:
  void erase_all_but(const std::vector<Pin>& pins);
  void end_silent_drags(Clock::time_point now);
  void end_drag(const std::string& name);
  void insert(const std::string& name, const Eigen::Vector3d& place, const Style& style);

  Listener listener_;
  std::map<std::string, std::optional<Eigen::Vector3d>> shown_;  ///< m; none: where the mouse left it
  std::map<std::string, Clock::time_point> dragged_;             ///< when they were last heard of
  interactive_markers::InteractiveMarkerServer server_;          ///< last: its callbacks use the others
};

}  // namespace cloth
