#pragma once

#include <functional>
#include <string>

#include <ros/node_handle.h>

namespace cloth
{

/// What the main function of a node returns: runs `node` in its private namespace. A fault that it throws is logged and
/// ends with failure; a signal, whenever it comes, does not.
int node_main(int argc, char** argv, const std::string& name, const std::function<void(const ros::NodeHandle&)>& node);

}  // namespace cloth
