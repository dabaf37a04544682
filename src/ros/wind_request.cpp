#include "wind_request.h"

#include "conversions.h"
#include "refused_request.h"

namespace cloth
{

Eigen::Vector3d wind_of(const geometry_msgs::Vector3Stamped& request, const Frames& frames)
{
  const Eigen::Vector3d wind = frames.from(request.header.frame_id).linear() * to_eigen(request.vector);
  if (!wind.allFinite())
  {
    throw RefusedRequest("vector is not finite");
  }
  return wind;
}

}  // namespace cloth
