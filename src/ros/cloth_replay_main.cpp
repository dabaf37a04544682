#include <ros/init.h>

#include "cloth_replay.h"
#include "node_main.h"
#include "node_scene.h"

int main(int argc, char** argv)
{
  return cloth::node_main(argc, argv, "cloth_replay", [](const ros::NodeHandle& private_node) {
    const auto scene = cloth::replay_scene_from_parameters(private_node.getNamespace());
    const cloth::ClothReplay replay(private_node, scene, private_node.param("bag", std::string()));
    ros::spin();
  });
}
