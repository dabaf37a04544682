#pragma once

#include <string>

#include <Eigen/Geometry>

#include <tf2/buffer_core.h>

namespace cloth
{

/// The way from other tf frames into the cloth's, by the latest transforms; never waits for one.
class Frames
{
public:
  /// `transforms` must outlive this object; another thread may fill it meanwhile.
  Frames(std::string frame_id, const tf2::BufferCore& transforms);

  const std::string& frame_id() const
  {
    return frame_id_;
  }

  /// Takes points (m) of the frame `source` into the cloth's frame, as the two stand now; an empty name is the cloth's
  /// frame. Throws RefusedRequest where tf does not know the way.
  Eigen::Isometry3d from(const std::string& source) const;

private:
  std::string frame_id_;
  const tf2::BufferCore& transforms_;
};

}  // namespace cloth
