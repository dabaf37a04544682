# One test program a room. With ROS they are catkin's tests; the core alone has them in CTest.

function(cloth_add_test room)
  set(sources ${ARGN})
  if(CLOTH_SIM_WITH_ROS)
    catkin_add_gtest(test_${room} ${sources} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    target_link_libraries(test_${room} cloth_run_parts ${GTEST_MAIN_LIBRARIES})
  else()
    add_executable(test_${room} ${sources})
    target_link_libraries(test_${room} cloth_run_parts GTest::gtest_main)
    add_test(NAME ${room} COMMAND test_${room} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  endif()
  target_include_directories(test_${room} PRIVATE ${PROJECT_SOURCE_DIR}/test)
endfunction()

if(SUNDIALS_FOUND)
  set(agreement_test test/methods/agreement_test.cpp)
  set(agreement_libraries SUNDIALS::cvode SUNDIALS::nvecserial SUNDIALS::sunlinsoldense SUNDIALS::sunmatrixdense
    SUNDIALS::sunnonlinsolfixedpoint)
else()
  message(STATUS "SUNDIALS 6 (libsundials-dev) is missing: test/methods/agreement_test.cpp is left out")
endif()

cloth_add_test(model
  test/model/cloth_model_test.cpp
  test/model/inverse_root_test.cpp
  test/model/lane_table_test.cpp
  test/model/spring_layout_test.cpp
  test/model/vectors_test.cpp
)
target_include_directories(test_model PRIVATE src/model)
cloth_add_test(forces
  test/forces/air_test.cpp
  test/forces/gravity_test.cpp
  test/forces/gusts_test.cpp
  test/forces/spring_jacobian_test.cpp
  test/forces/springs_test.cpp
)
cloth_add_test(constraints
  test/constraints/pin_reach_test.cpp
  test/constraints/pins_test.cpp
  test/constraints/spring_tensions_test.cpp
  test/constraints/strain_limit_test.cpp
)
cloth_add_test(methods
  ${agreement_test}
  test/methods/allocations_test.cpp
  test/methods/energy_drift_test.cpp
  test/methods/exact_motion_test.cpp
  test/methods/mixed_precision_test.cpp
  test/methods/multigrid_test.cpp
  test/methods/order_test.cpp
  test/methods/spectrum_test.cpp
  test/methods/stability_test.cpp
  test/methods/threads_test.cpp
)
target_link_libraries(test_methods ${agreement_libraries})
target_include_directories(test_methods PRIVATE src/methods)
cloth_add_test(simulation
  test/simulation/conservation_test.cpp
  test/simulation/divergence_test.cpp
  test/simulation/error_watch_test.cpp
  test/simulation/failure_test.cpp
  test/simulation/part_calls_test.cpp
  test/simulation/reactions_test.cpp
  test/simulation/settle_test.cpp
  test/simulation/simulation_test.cpp
  test/simulation/sleep_test.cpp
  test/simulation/stability_watch_test.cpp
  test/simulation/statics_test.cpp
)
cloth_add_test(planning
  test/planning/method_errors_test.cpp
  test/planning/planner_test.cpp
  test/planning/started_scene_test.cpp
  test/planning/step_costs_test.cpp
  test/planning/trials_test.cpp
)
target_include_directories(test_planning PRIVATE src/planning)
cloth_add_test(scene
  test/scene/catenary_test.cpp
  test/scene/choice_test.cpp
  test/scene/parameter_page_test.cpp
  test/scene/parameter_table_test.cpp
  test/scene/pin_selection_test.cpp
  test/scene/plan_test.cpp
  test/scene/scene_reader_test.cpp
  test/scene/scene_start_test.cpp
  test/scene/shipped_scenes_test.cpp
  test/scene/start_state_test.cpp
  test/scene/yaml_text_test.cpp
)
cloth_add_test(threads
  test/threads/crew_test.cpp
)
cloth_add_test(tools
  test/tools/cloth_run_output_test.cpp
  test/tools/cloth_run_test.cpp
  test/tools/replaced_file_test.cpp
  test/tools/run_options_test.cpp
)
# cloth_run is tested as a program.
target_compile_definitions(test_tools PRIVATE CLOTH_RUN="$<TARGET_FILE:cloth_run>")
add_dependencies(test_tools cloth_run)
cloth_add_test(bench
  test/bench/bench_test.cpp
  test/bench/cloth_bench_test.cpp
  test/bench/drawn_scene_test.cpp
  test/bench/errors_test.cpp
  test/bench/plan_trial_test.cpp
  test/bench/problem_test.cpp
  test/bench/reference_test.cpp
  test/bench/search_test.cpp
  test/bench/slopes_test.cpp
)
target_link_libraries(test_bench plan_matrix_parts)
target_compile_definitions(test_bench PRIVATE CLOTH_BENCH="$<TARGET_FILE:cloth_bench>")
add_dependencies(test_bench cloth_bench)

# What makes charts of measurements is tested in Python; without matplotlib the charts themselves are skipped.
if(CLOTH_SIM_WITH_ROS)
  set(chart_results ${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/python-charts.xml)
  catkin_run_tests_target(python charts python-charts.xml
    COMMAND "${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/bench/run.py ${chart_results}"
  )
else()
  find_program(CLOTH_SIM_PYTHON python3)
  if(CLOTH_SIM_PYTHON)
    add_test(NAME charts COMMAND ${CLOTH_SIM_PYTHON} ${PROJECT_SOURCE_DIR}/test/bench/run.py)
  endif()
endif()
