#pragma once

#include <string>

#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <ros/service.h>

#include "listener.h"

namespace cloth
{

/// Live keys of /cloth_node to be changed, by their flat names: asked for together, answered with the values in force.
class Change
{
public:
  template <typename Value>
  Change& set(const std::string& name, const Value& value)
  {
    dynamic_reconfigure::ConfigTools::appendParameter(request_.config, name, value);
    return *this;
  }
  Change& set(const std::string& name, const char* value)
  {
    return set(name, std::string(value));
  }

  /// False: the node does not answer.
  bool ask()
  {
    const std::string service = "/cloth_node/set_parameters";
    return wait_until([&] { return ros::service::exists(service, false); }) &&
           ros::service::call(service, request_, response_);
  }

  /// The value in force.
  template <typename Value>
  Value answered(const std::string& name) const
  {
    Value value{};
    dynamic_reconfigure::ConfigTools::getParameter(response_.config, name, value);
    return value;
  }

private:
  dynamic_reconfigure::ReconfigureRequest request_;
  dynamic_reconfigure::ReconfigureResponse response_;
};

}  // namespace cloth
