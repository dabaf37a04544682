#include <csignal>
#include <cstdlib>
#include <sstream>

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <unistd.h>

#include "cloth_sim/scene/scene_reader.h"

#include "cloth_node.h"
#include "node_scene.h"

namespace
{

/// roscpp ends a node on SIGINT alone, and not while it still looks for its master.
void shut_down(int /*signal*/)
{
  if (!ros::isStarted())
  {
    _exit(EXIT_SUCCESS);
  }
  ros::requestShutdown();
}

void log_faults(const cloth::SceneError& error)
{
  std::istringstream faults(error.what());
  for (std::string fault; std::getline(faults, fault);)
  {
    ROS_FATAL("%s", fault.c_str());
  }
}

}  // namespace

int main(int argc, char** argv)
{
  std::signal(SIGINT, shut_down);
  std::signal(SIGTERM, shut_down);
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
  catch (const cloth::SceneError& error)
  {
    log_faults(error);
  }
  catch (const std::exception& error)
  {
    ROS_FATAL("%s", error.what());
  }
  return EXIT_FAILURE;
}
