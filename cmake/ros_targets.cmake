include_directories(SYSTEM ${catkin_INCLUDE_DIRS})

# The ROS layer on top of the core: everything that the node does, as a library that tests can link, and a thin main.
add_library(cloth_ros STATIC
  src/ros/answering_services.cpp
  src/ros/bag_files.cpp
  src/ros/clock_publisher.cpp
  src/ros/cloth_node.cpp
  src/ros/cloth_replay.cpp
  src/ros/conversions.cpp
  src/ros/end_by_signal.cpp
  src/ros/errands.cpp
  src/ros/fault_log.cpp
  src/ros/frames.cpp
  src/ros/health.cpp
  src/ros/live_cloth.cpp
  src/ros/live_keys.cpp
  src/ros/mesh_marker.cpp
  src/ros/messages.cpp
  src/ros/new_marker.cpp
  src/ros/node_clock.cpp
  src/ros/node_main.cpp
  src/ros/node_scene.cpp
  src/ros/pin_attachments.cpp
  src/ros/pin_handles.cpp
  src/ros/pin_markers.cpp
  src/ros/pin_requests.cpp
  src/ros/pin_wrenches.cpp
  src/ros/recorded_model.cpp
  src/ros/recorded_start.cpp
  src/ros/recorded_topologies.cpp
  src/ros/refusal_log.cpp
  src/ros/replayed_cloth.cpp
  src/ros/ribbon.cpp
  src/ros/scene_display.cpp
  src/ros/shading.cpp
  src/ros/spring_marker.cpp
  src/ros/tick_clock.cpp
  src/ros/tick_statistics.cpp
  src/ros/tuning.cpp
  src/ros/wind_request.cpp
  src/ros/wind_time_out.cpp
)
add_dependencies(cloth_ros ${${PROJECT_NAME}_EXPORTED_TARGETS} ${catkin_EXPORTED_TARGETS})
set_target_properties(cloth_ros PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_include_directories(cloth_ros PUBLIC src/ros)
target_link_libraries(cloth_ros PUBLIC cloth_core ${catkin_LIBRARIES})

# The same code for nodelet managers.
add_library(cloth_nodelet MODULE src/ros/cloth_nodelet.cpp)
target_link_libraries(cloth_nodelet PRIVATE cloth_ros)

add_executable(cloth_node src/ros/cloth_node_main.cpp)
target_link_libraries(cloth_node PRIVATE cloth_ros)

add_executable(cloth_replay src/ros/cloth_replay_main.cpp)
target_link_libraries(cloth_replay PRIVATE cloth_ros)

install(TARGETS cloth_core cloth_nodelet
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION}
)
install(TARGETS cloth_bench cloth_node cloth_replay cloth_run parameter_page
  RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION}
)
install(DIRECTORY include/${PROJECT_NAME}/
  DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION}
)
install(FILES nodelet_plugins.xml
  DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}
)
install(DIRECTORY config launch
  DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}
)
# What cloth_bench needs beside itself: its scenes, and what draws charts.
install(DIRECTORY bench/
  DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/bench
  USE_SOURCE_PERMISSIONS
  FILES_MATCHING PATTERN "*.py" PATTERN "scenes/*.yaml" PATTERN stability_map.csv
  PATTERN cloth_bench EXCLUDE
  PATTERN __pycache__ EXCLUDE
)
