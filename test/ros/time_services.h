#pragma once

#include <string>

#include <ros/service.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include "listener.h"

namespace cloth
{

/// Calls a service of /cloth_node once it is there; an answer that does not come is a refusal in these words.
template <typename Service>
typename Service::Response call(const std::string& name, const typename Service::Request& request = {})
{
  typename Service::Response response;
  const std::string service = "/cloth_node/" + name;
  if (!wait_until([&] { return ros::service::exists(service, false); }) ||
      !ros::service::call(service, const_cast<typename Service::Request&>(request), response))
  {
    response.success = 0;
    response.message = service + " does not answer";
  }
  return response;
}

inline std_srvs::Trigger::Response trigger(const std::string& name)
{
  return call<std_srvs::Trigger>(name);
}

inline std_srvs::SetBool::Response set_paused(bool paused)
{
  std_srvs::SetBool::Request request;
  request.data = paused ? 1 : 0;
  return call<std_srvs::SetBool>("set_paused", request);
}

}  // namespace cloth
