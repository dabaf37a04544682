#pragma once

#include <mutex>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include <ros/time.h>
#include <tf2/buffer_core.h>

namespace cloth
{

/// The way from other tf frames into the cloth's, by the latest transforms; never waits for one. May be used from
/// several threads.
class Frames
{
public:
  /// `transforms` must outlive this object; another thread may fill it meanwhile.
  Frames(std::string frame_id, tf2::BufferCore& transforms);

  std::string frame_id() const;
  /// The cloth's frame from now on.
  void set_frame_id(const std::string& frame_id);

  /// Takes points (m) of another frame into the cloth's.
  struct Latest
  {
    Eigen::Isometry3d transform;
    ros::Time stamp;  ///< zero: it holds at any time
  };

  /// Forgets all transforms but static ones: those of before ROS time jumped back hide those that come now.
  void forget_transforms() const
  {
    transforms_.clear();
  }

  /// From the frame `source`, or none where tf does not know the way; an empty name is the cloth's frame.
  std::optional<Latest> latest(const std::string& source) const;

  /// Takes points (m) of the frame `source` into the cloth's frame, as the two stand now; an empty name is the cloth's
  /// frame. Throws RefusedRequest where tf does not know the way.
  Eigen::Isometry3d from(const std::string& source) const;

  /// A transform that was looked up and found.
  struct Use
  {
    std::string frame;          ///< from which
    std::optional<double> age;  ///< s, what it was old then; none: static
  };

  /// The last one; none: only the cloth's own frame was asked for so far.
  std::optional<Use> last_use() const;

private:
  void note_use(const std::string& source, const ros::Time& stamp) const;

  mutable std::mutex mutex_;
  std::string frame_id_;
  mutable std::optional<Use> last_use_;
  tf2::BufferCore& transforms_;
};

}  // namespace cloth
