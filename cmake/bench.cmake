# Programs that make the figures of docs/. No part of what is built without being asked for: make stability_map.
# Nor of an installation.
#catkin_lint: ignore uninstalled_target

add_executable(stability_map EXCLUDE_FROM_ALL bench/stability_map.cpp)
target_link_libraries(stability_map cloth_core)
