#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include <Eigen/Geometry>
#include <ros/time.h>

#include "cloth_sim/scene/scene_params.h"
#include "cloth_sim/simulation/simulation.h"

#include "frames.h"

namespace cloth
{

/// The pins that tf frames carry. A pinned node turns with the frame as if glued to it. For one thread alone.
class PinAttachments
{
public:
  using Warn = std::function<void(const std::string&)>;

  explicit PinAttachments(const TfPinParams& params);

  /// From now on `frame` carries the pin `name`, from where both are when the frame is seen first. With `keep_offset`
  /// each node stays where it is on the frame then; without, the middle of the pin's nodes goes to the frame's origin.
  void attach(const std::string& name, const std::string& frame, bool keep_offset);
  /// The pin `name`, if a frame carries it, stays where it is.
  void detach(const std::string& name);
  void clear();

  /// Sends every attached pin on its way to where its frame is by the latest transform, to be there at the simulated
  /// time `end` (s). From tick to tick no node goes faster than top_speed; what is farther away is caught up with
  /// later. A pin whose frame is not known, or not of late at the ROS time `now`, holds its place; transforms of a time
  /// to come are forgotten. `warn` is told of jumps and of pins that hold, in the same words each tick.
  void carry(const Frames& frames, const ros::Time& now, double end, Simulation& simulation, const Warn& warn);

private:
  struct Attachment
  {
    std::string frame;
    bool keep_offset = true;
    std::optional<Eigen::Isometry3d> first;  ///< where the frame was when it was seen first
    bool has_arrived = false;                ///< the pin was where the frame has it
  };

  /// Where the frame is; none, having warned, where that is not known.
  std::optional<Eigen::Isometry3d> find(const std::string& name, const Attachment& attachment, const Frames& frames,
                                        const ros::Time& now, const Warn& warn) const;

  TfPinParams params_;
  std::map<std::string, Attachment> attachments_;  ///< by the name of the pin
};

}  // namespace cloth
