# Tests of the ROS layer: those of its parts need no master; the rostests run the node on a master of their own.
catkin_add_gtest(test_ros
  test/ros/bag_files_test.cpp
  test/ros/conversions_test.cpp
  test/ros/errands_test.cpp
  test/ros/health_test.cpp
  test/ros/live_keys_test.cpp
  test/ros/mesh_marker_test.cpp
  test/ros/messages_test.cpp
  test/ros/node_scene_test.cpp
  test/ros/pin_attachments_test.cpp
  test/ros/pin_markers_test.cpp
  test/ros/pin_requests_test.cpp
  test/ros/recorded_model_test.cpp
  test/ros/recorded_topologies_test.cpp
  test/ros/refusal_log_test.cpp
  test/ros/reused_messages_test.cpp
  test/ros/shading_test.cpp
  test/ros/tick_clock_test.cpp
  test/ros/tick_statistics_test.cpp
  test/ros/wind_time_out_test.cpp
)
target_link_libraries(test_ros cloth_ros ${GTEST_MAIN_LIBRARIES})
target_include_directories(test_ros PRIVATE test)

# Tests run in the environment that catkin saved when this folder was configured first: without the folders that its set-up
# leaves out while they are not there, and so without the Python classes of our messages, which rostopic needs.
file(MAKE_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_PYTHON_DESTINATION})
safe_execute_process(COMMAND ${GENERATE_ENVIRONMENT_CACHE_COMMAND})

find_package(rosbag REQUIRED)
find_package(roslaunch REQUIRED)
find_package(rostest REQUIRED)
include_directories(SYSTEM ${rosbag_INCLUDE_DIRS})

add_library(cloth_rostest STATIC EXCLUDE_FROM_ALL
  test/ros/child_process.cpp
  test/ros/rostest_main.cpp
  test/ros/stalled_listener.cpp
)
target_link_libraries(cloth_rostest PUBLIC cloth_ros ${rosbag_LIBRARIES} ${GTEST_LIBRARIES})

foreach(name
    bag clock divergence health lost_master master_clock nodelet pin_handles reload replay requests robustness sleep
    start_bag start_up streams tf_pins time tuning two_cloths wind wrenches)
  add_rostest_gtest(ros_${name}_test test/ros/${name}.test
    test/ros/${name}_rostest.cpp
  )
  target_link_libraries(ros_${name}_test cloth_rostest)
  target_compile_definitions(ros_${name}_test PRIVATE CLOTH_NODE="$<TARGET_FILE:cloth_node>"
    CLOTH_REPLAY="$<TARGET_FILE:cloth_replay>")
  add_dependencies(ros_${name}_test cloth_node cloth_nodelet cloth_replay)
endforeach()

roslaunch_add_file_check(launch IGNORE_UNSET_ARGS)
roslaunch_add_file_check(launch/record.launch bag:=cloth.bag)
roslaunch_add_file_check(launch/replay.launch bag:=cloth.bag loop:=true)
roslaunch_add_file_check(launch/cloth.launch start_bag:=/tmp/cloth.bag start_time:=2)
roslaunch_add_file_check(launch/nodelet.launch start_manager:=false)
roslaunch_add_file_check(launch/two_cloths.launch rviz:=false)
