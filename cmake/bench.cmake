# Programs that make the figures of docs/. No part of what is built without being asked for: make stability_map.
# Nor of an installation.
#catkin_lint: ignore uninstalled_target

foreach(figures IN ITEMS method_table stability_map)
  add_executable(${figures} EXCLUDE_FROM_ALL bench/${figures}.cpp)
  target_link_libraries(${figures} cloth_core)
endforeach()

find_package(benchmark QUIET)
if(benchmark_FOUND)
  add_executable(linear_solver EXCLUDE_FROM_ALL
    bench/assembled_matrix.cpp
    bench/linear_solver.cpp
  )
  target_include_directories(linear_solver PRIVATE src/methods)
  target_compile_options(linear_solver PRIVATE $<$<CONFIG:Release>:-O3>)
  target_link_libraries(linear_solver cloth_core benchmark::benchmark)
else()
  message(STATUS "Google Benchmark (libbenchmark-dev) is missing: bench/linear_solver.cpp is left out")
endif()
