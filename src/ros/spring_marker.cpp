#include "spring_marker.h"

#include <algorithm>

#include "conversions.h"

namespace cloth
{
namespace
{

Eigen::Vector3d colour_of(SpringKind kind)
{
  switch (kind)
  {
    case SpringKind::structural:
      return { 0.95, 0.95, 0.90 };
    case SpringKind::shear:
      return { 0.30, 0.75, 0.85 };
    default:
      return { 0.95, 0.65, 0.20 };
  }
}

}  // namespace

SpringMarker::SpringMarker(const ClothModel& model, const std::string& frame_id) : model_(model)
{
  marker_.header.frame_id = frame_id;
  marker_.ns = "springs";
  marker_.type = visualization_msgs::Marker::LINE_LIST;
  marker_.action = visualization_msgs::Marker::ADD;
  marker_.pose.orientation.w = 1.0;
  marker_.scale.x = 0.001 * std::max(model.width, model.height);
  marker_.color = to_colour(colour_of(SpringKind::structural));
}

const visualization_msgs::Marker& SpringMarker::update(const Vectors& positions, const ros::Time& stamp)
{
  marker_.header.stamp = stamp;
  marker_.points.clear();
  marker_.colors.clear();
  for (const SpringBatch& batch : model_.springs)
  {
    const std_msgs::ColorRGBA colour = to_colour(colour_of(batch.kind));
    for_each_spring(batch, [&](int i, int j) {
      marker_.points.push_back(to_point(positions, i));
      marker_.points.push_back(to_point(positions, j));
      marker_.colors.insert(marker_.colors.end(), 2, colour);
    });
  }
  return marker_;
}

}  // namespace cloth
