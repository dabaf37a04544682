#include <cstdlib>

#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include "cloth_node.h"
#include "end_by_signal.h"
#include "fault_log.h"
#include "node_scene.h"

int main(int argc, char** argv)
{
  cloth::end_by_signal();
  ros::init(argc, argv, "cloth_node", ros::init_options::NoSigintHandler);
  // ROS shuts down with its last handle, and logs nothing then: this one outlives what is reported below.
  const ros::NodeHandle private_node("~");
  if (!ros::ok())
  {
    return EXIT_SUCCESS;
  }
  try
  {
    const auto scene = cloth::scene_from_parameters(private_node.getNamespace());
    cloth::ClothNode node(private_node, scene);
    ros::AsyncSpinner spinner(1);
    spinner.start();
    node.run();
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    cloth::log_fault(error);
  }
  return EXIT_FAILURE;
}
