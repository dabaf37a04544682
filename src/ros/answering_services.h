#pragma once

#include <functional>
#include <string>

#include <ros/node_handle.h>
#include <ros/service_server.h>

#include "errands.h"

namespace cloth
{

/// A std_srvs/Trigger that answers what `action` does.
ros::ServiceServer advertise_trigger(ros::NodeHandle& node, const std::string& name, std::function<Answer()> action);

/// A std_srvs/SetBool that answers what `action` does with the request's data.
ros::ServiceServer advertise_switch(ros::NodeHandle& node, const std::string& name, std::function<Answer(bool)> action);

}  // namespace cloth
