# Messages, and what the package offers to others. Before any target, so that catkin's output folders apply to all.
find_package(catkin REQUIRED COMPONENTS
  diagnostic_msgs
  diagnostic_updater
  dynamic_reconfigure
  geometry_msgs
  interactive_markers
  message_generation
  nodelet
  pluginlib
  rosbag_storage
  roscpp
  rosgraph_msgs
  roslib
  std_msgs
  std_srvs
  tf2
  tf2_ros
  visualization_msgs
)

add_message_files(FILES
  ClothState.msg
  ClothStats.msg
  ClothTopology.msg
  Pin.msg
)
generate_messages(DEPENDENCIES geometry_msgs std_msgs)
generate_dynamic_reconfigure_options(cfg/Cloth.cfg)

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES cloth_core
  CATKIN_DEPENDS geometry_msgs message_runtime std_msgs
)
