# plan_matrix, which holds the planner's choices against an exhaustive search. No part of what is built without being
# asked for: make plan_matrix. Nor of an installation.
#catkin_lint: ignore uninstalled_target

add_library(plan_matrix_parts STATIC EXCLUDE_FROM_ALL
  bench/plan_matrix/draw.cpp
  bench/plan_matrix/drawn_scene.cpp
  bench/plan_matrix/exact_motion.cpp
  bench/plan_matrix/matrix_folder.cpp
  bench/plan_matrix/matrix_options.cpp
  bench/plan_matrix/matrix_rows.cpp
  bench/plan_matrix/part.cpp
  bench/plan_matrix/plan_trial.cpp
  bench/plan_matrix/planned_run.cpp
  bench/plan_matrix/scene_search.cpp
  bench/plan_matrix/search.cpp
)
target_include_directories(plan_matrix_parts PUBLIC bench/plan_matrix PRIVATE src/planning)
target_link_libraries(plan_matrix_parts PUBLIC cloth_bench_parts)

add_executable(plan_matrix EXCLUDE_FROM_ALL bench/plan_matrix/plan_matrix.cpp)
target_link_libraries(plan_matrix plan_matrix_parts)
