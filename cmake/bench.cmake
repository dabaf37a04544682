# Programs that make the figures of docs/. No part of what is built without being asked for: make stability_map.
# Nor of an installation.
#catkin_lint: ignore uninstalled_target

add_executable(method_table EXCLUDE_FROM_ALL bench/method_table.cpp)
target_link_libraries(method_table cloth_core)

add_executable(stability_map EXCLUDE_FROM_ALL
  bench/measured_stability.cpp
  bench/stability_map.cpp
)
target_link_libraries(stability_map cloth_core)

add_executable(precision_error EXCLUDE_FROM_ALL
  bench/level_sheet.cpp
  bench/precision_error.cpp
)
target_link_libraries(precision_error cloth_core)

find_package(benchmark QUIET)
if(benchmark_FOUND)
  add_executable(linear_solver EXCLUDE_FROM_ALL
    bench/assembled_matrix.cpp
    bench/linear_solver.cpp
  )
  target_include_directories(linear_solver PRIVATE src/methods)
  target_compile_options(linear_solver PRIVATE $<$<CONFIG:Release>:-O3>)
  target_link_libraries(linear_solver cloth_core benchmark::benchmark)

  add_executable(step_cost EXCLUDE_FROM_ALL
    bench/plain_sheet.cpp
    bench/step_cost.cpp
  )
  # What is measured against gets all that a compiler can do for this machine.
  set_source_files_properties(bench/plain_sheet.cpp PROPERTIES
    COMPILE_OPTIONS "-O3;-march=native;-fno-math-errno;-fno-trapping-math"
  )
  target_link_libraries(step_cost cloth_core benchmark::benchmark)

  add_executable(limit_cost EXCLUDE_FROM_ALL
    bench/level_sheet.cpp
    bench/limit_cost.cpp
  )
  target_link_libraries(limit_cost cloth_core benchmark::benchmark)

  if(CLOTH_SIM_WITH_ROS)
    add_executable(tick_cost EXCLUDE_FROM_ALL bench/tick_cost.cpp)
    target_link_libraries(tick_cost cloth_ros benchmark::benchmark)
  endif()
else()
  message(STATUS "Google Benchmark (libbenchmark-dev) is missing: what needs it in bench/ is left out")
endif()

if(BULLET_FOUND)
  add_executable(against_bullet EXCLUDE_FROM_ALL
    bench/against_bullet.cpp
    bench/level_sheet.cpp
  )
  target_include_directories(against_bullet SYSTEM PRIVATE ${BULLET_INCLUDE_DIR} ${BULLET_INCLUDE_DIRS})
  target_link_libraries(against_bullet cloth_core ${BULLET_LIBRARIES})
else()
  message(STATUS "Bullet (libbullet-dev) is missing: against_bullet is left out")
endif()
