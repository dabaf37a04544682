#include "frames.h"

#include <utility>

#include <ros/time.h>
#include <tf2/exceptions.h>

#include "refused_request.h"

namespace cloth
{

Frames::Frames(std::string frame_id, tf2::BufferCore& transforms)
  : frame_id_(std::move(frame_id)), transforms_(transforms)
{
}

std::string Frames::frame_id() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return frame_id_;
}

void Frames::set_frame_id(const std::string& frame_id)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  frame_id_ = frame_id;
}

std::optional<Frames::Latest> Frames::latest(const std::string& source) const
{
  const std::string target = frame_id();
  if (source.empty() || source == target)
  {
    return Latest{ Eigen::Isometry3d::Identity(), ros::Time() };
  }
  try
  {
    const auto found = transforms_.lookupTransform(target, source, ros::Time(0));
    note_use(source, found.header.stamp);
    const auto& t = found.transform.translation;
    const auto& q = found.transform.rotation;
    return Latest{ Eigen::Translation3d(t.x, t.y, t.z) * Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized(),
                   found.header.stamp };
  }
  catch (const tf2::TransformException&)
  {
    return std::nullopt;
  }
}

Eigen::Isometry3d Frames::from(const std::string& source) const
{
  const auto found = latest(source);
  if (!found)
  {
    throw RefusedRequest("tf knows no transform from frame '" + source + "' to '" + frame_id() + "'");
  }
  return found->transform;
}

std::optional<Frames::Use> Frames::last_use() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_use_;
}

void Frames::note_use(const std::string& source, const ros::Time& stamp) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  // Numbers: a ros::Duration throws where stamps are more than 68 years apart.
  const auto age = [&] { return ros::Time::now().toSec() - stamp.toSec(); };
  last_use_ = Use{ source, stamp.isZero() ? std::nullopt : std::make_optional(age()) };
}

}  // namespace cloth
