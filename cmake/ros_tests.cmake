# Tests of the ROS layer: those of its parts need no master; the rostests run the node on a master of their own.
catkin_add_gtest(test_ros
  test/ros/conversions_test.cpp
  test/ros/mesh_marker_test.cpp
  test/ros/messages_test.cpp
  test/ros/node_scene_test.cpp
  test/ros/pin_markers_test.cpp
  test/ros/pin_requests_test.cpp
  test/ros/refusal_log_test.cpp
  test/ros/shading_test.cpp
  test/ros/tick_clock_test.cpp
  test/ros/tick_statistics_test.cpp
)
target_link_libraries(test_ros cloth_ros ${GTEST_MAIN_LIBRARIES})
target_include_directories(test_ros PRIVATE test)

find_package(rosbag REQUIRED)
find_package(rosgraph_msgs REQUIRED)
find_package(rostest REQUIRED)

function(cloth_add_rostest name)
  set(target ros_${name}_test)
  add_rostest_gtest(${target} test/ros/${name}.test
    test/ros/${name}_rostest.cpp
    test/ros/child_process.cpp
    test/ros/rostest_main.cpp
  )
  target_link_libraries(${target} cloth_ros ${rosbag_LIBRARIES})
  target_include_directories(${target} SYSTEM PRIVATE ${rosbag_INCLUDE_DIRS} ${rosgraph_msgs_INCLUDE_DIRS})
  target_compile_definitions(${target} PRIVATE CLOTH_NODE="$<TARGET_FILE:cloth_node>")
  add_dependencies(${target} cloth_node)
endfunction()

cloth_add_rostest(bag)
cloth_add_rostest(clock)
cloth_add_rostest(divergence)
cloth_add_rostest(requests)
cloth_add_rostest(start_up)
cloth_add_rostest(streams)
