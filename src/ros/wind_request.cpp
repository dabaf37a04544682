#include "wind_request.h"

#include "cloth_sim/scene/yaml_text.h"

#include "conversions.h"
#include "refused_request.h"

namespace cloth
{
namespace
{

/// Faster than any wind, and slow enough to reckon with, m/s.
constexpr double fastest_wind = 1000.0;

}  // namespace

Eigen::Vector3d wind_of(const geometry_msgs::Vector3Stamped& request, const Frames& frames)
{
  const Eigen::Vector3d wind = frames.from(request.header.frame_id).linear() * to_eigen(request.vector);
  if (!wind.allFinite())
  {
    throw RefusedRequest("vector is not finite");
  }
  if (wind.norm() > fastest_wind)
  {
    throw RefusedRequest("vector is " + format_number(wind.norm()) + " m/s long; allowed: up to " +
                         format_number(fastest_wind));
  }
  return wind;
}

}  // namespace cloth
