#include <cstdlib>

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include "cloth_replay.h"
#include "end_by_signal.h"
#include "node_scene.h"

int main(int argc, char** argv)
{
  cloth::end_by_signal();
  ros::init(argc, argv, "cloth_replay", ros::init_options::NoSigintHandler);
  // ROS shuts down with its last handle, and logs nothing then: this one outlives what is reported below.
  const ros::NodeHandle private_node("~");
  if (!ros::ok())
  {
    return EXIT_SUCCESS;
  }
  try
  {
    const auto scene = cloth::replay_scene_from_parameters(private_node.getNamespace());
    const cloth::ClothReplay replay(private_node, scene, private_node.param("bag", std::string()));
    ros::spin();
    return EXIT_SUCCESS;
  }
  catch (const std::exception& error)
  {
    ROS_FATAL("%s", error.what());
  }
  return EXIT_FAILURE;
}
