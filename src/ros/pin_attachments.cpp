#include "pin_attachments.h"

#include <cmath>

#include "cloth_sim/scene/yaml_text.h"

namespace cloth
{
namespace
{

/// A way of the pin's nodes, and the point of them that goes in a straight line.
struct Way
{
  Eigen::Isometry3d placement;
  Eigen::Vector3d pivot;
  bool is_whole = true;
};

/// Where the frame, having gone from `first` to `now`, has the pin's nodes.
Way to_frame(const Pin& pin, bool keep_offset, const Eigen::Isometry3d& first, const Eigen::Isometry3d& now)
{
  const Eigen::Isometry3d moved = now * first.inverse();
  if (keep_offset)
  {
    return { moved, first.translation() };
  }
  const Eigen::Vector3d middle = pin.held_middle();
  const Eigen::Isometry3d turn(moved.linear());
  return { Eigen::Translation3d(now.translation()) * turn * Eigen::Translation3d(-middle), middle };
}

/// The beginning of the way, as much of it as the fastest node may go: `longest`, m. The middle of the nodes then goes
/// in a straight line.
Way shortened(const Pin& pin, const Eigen::Isometry3d& from, const Way& way, double longest)
{
  const Eigen::Vector3d middle = pin.held_middle();
  const Eigen::Vector3d shift = way.placement * middle - from * middle;
  const Eigen::AngleAxisd turn(Eigen::Quaterniond(way.placement.linear() * from.linear().transpose()));
  const double length = shift.norm() + turn.angle() * pin.reach();
  if (!(length > longest))
  {
    return way;
  }
  const double part = longest / length;
  const Eigen::Vector3d place = from * middle + part * shift;
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(part * turn.angle(), turn.axis()) * from.linear();
  return { Eigen::Translation3d(place) * Eigen::Isometry3d(rotation) * Eigen::Translation3d(-middle), middle, false };
}

/// Nearer than a rounding error of any frame that moves.
bool is_there(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to)
{
  return from.isApprox(to, 1e-13);
}

}  // namespace

PinAttachments::PinAttachments(const TfPinParams& params) : params_(params)
{
}

void PinAttachments::attach(const std::string& name, const std::string& frame, bool keep_offset)
{
  attachments_[name] = { frame, keep_offset, std::nullopt, keep_offset };
}

void PinAttachments::detach(const std::string& name)
{
  attachments_.erase(name);
}

void PinAttachments::clear()
{
  attachments_.clear();
}

void PinAttachments::carry(const Frames& frames, const ros::Time& now, double end, Simulation& simulation,
                           const Warn& warn)
{
  const double time = simulation.state().time;
  for (auto entry = attachments_.begin(); entry != attachments_.end();)
  {
    auto& [name, attachment] = *entry;
    const Pin* const pin = simulation.pins().find(name);
    if (pin == nullptr)
    {
      entry = attachments_.erase(entry);
      continue;
    }
    ++entry;
    const auto frame = find(name, attachment, frames, now, warn);
    if (!frame || end <= time)
    {
      continue;
    }
    if (!attachment.first)
    {
      attachment.first = frame;
    }
    const Eigen::Isometry3d from = pin->carry.placement(time);
    const Way whole = to_frame(*pin, attachment.keep_offset, *attachment.first, *frame);
    const Way way = shortened(*pin, from, whole, params_.top_speed * (end - time));
    if (!is_there(from, way.placement))
    {
      simulation.carry(name, way.placement, way.pivot, end);
    }
    if (!way.is_whole && attachment.has_arrived)
    {
      warn("frame '" + attachment.frame + "' jumped: the pin '" + name + "' follows it at tf_pins.top_speed, " +
           format_number(params_.top_speed) + " m/s");
    }
    attachment.has_arrived = way.is_whole;
  }
}

std::optional<Eigen::Isometry3d> PinAttachments::find(const std::string& name, const Attachment& attachment,
                                                      const Frames& frames, const ros::Time& now,
                                                      const Warn& warn) const
{
  const auto latest = frames.latest(attachment.frame);
  if (!latest || !latest->transform.matrix().allFinite())
  {
    warn("the pin '" + name + "' holds its place: tf knows no transform from frame '" + attachment.frame + "' to '" +
         frames.frame_id() + "'");
    return std::nullopt;
  }
  const bool has_age = !latest->stamp.isZero() && !now.isZero();
  if (params_.max_age > 0.0 && has_age && std::abs(now.toSec() - latest->stamp.toSec()) > params_.max_age)
  {
    warn("the pin '" + name + "' holds its place: the latest transform of frame '" + attachment.frame +
         "' is farther from now than tf_pins.max_age, " + format_number(params_.max_age) + " s");
    if (latest->stamp > now)
    {
      frames.forget_transforms();
    }
    return std::nullopt;
  }
  return latest->transform;
}

}  // namespace cloth
