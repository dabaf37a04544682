#include "node_main.h"

#include <cstdlib>

#include <ros/init.h>

#include "end_by_signal.h"
#include "fault_log.h"

namespace cloth
{

int node_main(int argc, char** argv, const std::string& name, const std::function<void(const ros::NodeHandle&)>& node)
{
  end_by_signal();
  ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  // ROS shuts down with its last handle, and logs nothing then: this one outlives what is reported below.
  const ros::NodeHandle private_node("~");
  if (!ros::ok())
  {
    return EXIT_SUCCESS;
  }
  try
  {
    node(private_node);
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    log_fault(error);
  }
  return EXIT_FAILURE;
}

}  // namespace cloth
