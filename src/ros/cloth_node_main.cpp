#include <ros/spinner.h>

#include "cloth_node.h"
#include "node_main.h"
#include "node_scene.h"

int main(int argc, char** argv)
{
  return cloth::node_main(argc, argv, "cloth_node", [](const ros::NodeHandle& private_node) {
    const auto scene = cloth::scene_from_parameters(private_node.getNamespace());
    cloth::ClothNode node(private_node, scene);
    ros::AsyncSpinner spinner(1);
    spinner.start();
    node.run();
  });
}
