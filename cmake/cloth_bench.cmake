# cloth_bench, which charts speed against accuracy. Solvers of others are compared with where they are there.

# The older interface of SUNDIALS 5 and before does not do.
find_package(SUNDIALS 6 QUIET COMPONENTS
  cvode nvecserial sunlinsoldense sunlinsolspgmr sunmatrixdense sunnonlinsolfixedpoint
)
find_package(Boost QUIET)
find_package(Bullet QUIET)

# The commit is looked up at every build.
set(commit_source ${CMAKE_CURRENT_BINARY_DIR}/cloth_bench_commit.cpp)
add_custom_target(cloth_bench_commit
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUTPUT=${commit_source}
    -P ${PROJECT_SOURCE_DIR}/cmake/commit.cmake
  BYPRODUCTS ${commit_source}
)

add_library(cloth_bench_parts STATIC
  bench/cloth_bench/bench.cpp
  bench/cloth_bench/bench_options.cpp
  bench/cloth_bench/bench_scene.cpp
  bench/cloth_bench/charts.cpp
  bench/cloth_bench/competitors.cpp
  bench/cloth_bench/errors.cpp
  bench/cloth_bench/first_order_system.cpp
  bench/cloth_bench/journal.cpp
  bench/cloth_bench/line_file.cpp
  bench/cloth_bench/measurement.cpp
  bench/cloth_bench/one_core.cpp
  bench/cloth_bench/own_solver.cpp
  bench/cloth_bench/problem.cpp
  bench/cloth_bench/progress.cpp
  bench/cloth_bench/provenance.cpp
  bench/cloth_bench/reference.cpp
  bench/cloth_bench/reference_file.cpp
  bench/cloth_bench/shipped_files.cpp
  bench/cloth_bench/solver.cpp
  bench/cloth_bench/spatial.cpp
  bench/cloth_bench/tables.cpp
  bench/cloth_bench/timed_outcome.cpp
  bench/cloth_bench/yardstick.cpp
)
target_sources(cloth_bench_parts PRIVATE ${commit_source})
set_source_files_properties(${commit_source} PROPERTIES GENERATED TRUE)
add_dependencies(cloth_bench_parts cloth_bench_commit)
target_include_directories(cloth_bench_parts PUBLIC bench/cloth_bench)
target_compile_definitions(cloth_bench_parts PRIVATE
  CLOTH_BENCH_BUILD_TYPE="${CMAKE_BUILD_TYPE}"
  CLOTH_BENCH_SOURCE_FOLDER="${PROJECT_SOURCE_DIR}/bench"
)
target_link_libraries(cloth_bench_parts PUBLIC cloth_run_parts)

if(SUNDIALS_FOUND)
  target_sources(cloth_bench_parts PRIVATE bench/cloth_bench/cvode_solver.cpp)
  target_compile_definitions(cloth_bench_parts PUBLIC CLOTH_BENCH_HAS_CVODE)
  target_link_libraries(cloth_bench_parts PUBLIC SUNDIALS::cvode SUNDIALS::nvecserial SUNDIALS::sunlinsolspgmr
    SUNDIALS::sunnonlinsolfixedpoint)
else()
  message(STATUS "SUNDIALS 6 (libsundials-dev) is missing: cloth_bench does without CVODE")
endif()
if(Boost_FOUND)
  target_sources(cloth_bench_parts PRIVATE bench/cloth_bench/odeint_solver.cpp)
  # As fast as what it is compared with.
  set_source_files_properties(bench/cloth_bench/odeint_solver.cpp PROPERTIES COMPILE_OPTIONS "-O3")
  target_include_directories(cloth_bench_parts SYSTEM PRIVATE ${Boost_INCLUDE_DIRS})
  target_compile_definitions(cloth_bench_parts PUBLIC CLOTH_BENCH_HAS_ODEINT)
else()
  message(STATUS "Boost (libboost-dev) is missing: cloth_bench does without odeint")
endif()
if(BULLET_FOUND)
  target_sources(cloth_bench_parts PRIVATE bench/cloth_bench/bullet_solver.cpp)
  target_include_directories(cloth_bench_parts SYSTEM PRIVATE ${BULLET_INCLUDE_DIR} ${BULLET_INCLUDE_DIRS})
  target_compile_definitions(cloth_bench_parts PUBLIC CLOTH_BENCH_HAS_BULLET)
  target_link_libraries(cloth_bench_parts PUBLIC ${BULLET_LIBRARIES})
else()
  message(STATUS "Bullet (libbullet-dev) is missing: cloth_bench does without it")
endif()

add_executable(cloth_bench bench/cloth_bench/cloth_bench.cpp)
target_link_libraries(cloth_bench cloth_bench_parts)
