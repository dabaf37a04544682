#include "spring_marker.h"

#include <algorithm>

#include "conversions.h"
#include "new_marker.h"

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
  visualization_msgs::Marker marker = new_marker(frame_id, "springs", visualization_msgs::Marker::LINE_LIST);
  marker.scale.x = 0.001 * std::max(model.width, model.height);
  marker.color = to_colour(colour_of(SpringKind::structural));
  markers_ = ReusedMessages<visualization_msgs::Marker>(marker);
}

visualization_msgs::Marker::ConstPtr SpringMarker::update(const Vectors& positions, const ros::Time& stamp)
{
  const visualization_msgs::Marker::Ptr marker = markers_.take();
  marker->header.stamp = stamp;
  marker->points.clear();
  marker->colors.clear();
  for (const SpringBatch& batch : model_.springs)
  {
    const std_msgs::ColorRGBA colour = to_colour(colour_of(batch.kind));
    for_each_spring(batch, [&](int i, int j) {
      marker->points.push_back(to_point(positions, i));
      marker->points.push_back(to_point(positions, j));
      marker->colors.insert(marker->colors.end(), 2, colour);
    });
  }
  return marker;
}

}  // namespace cloth
