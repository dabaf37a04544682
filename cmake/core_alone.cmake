# What is installed and tested where there is no ROS.

include(GNUInstallDirs)
install(TARGETS cloth_bench cloth_core cloth_run parameter_page
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
)
# Not to an installation of catkin.
#catkin_lint: ignore_once wrong_install_destination
install(DIRECTORY include/${PROJECT_NAME}/
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${PROJECT_NAME}
)
# What cloth_bench needs beside itself: its scenes, and what draws charts.
#catkin_lint: ignore_once wrong_install_destination
install(DIRECTORY bench/
  DESTINATION ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME}/bench
  USE_SOURCE_PERMISSIONS
  FILES_MATCHING PATTERN "*.py" PATTERN "scenes/*.yaml" PATTERN stability_map.csv
  PATTERN cloth_bench EXCLUDE
  PATTERN __pycache__ EXCLUDE
)

include(CTest)
if(BUILD_TESTING)
  find_package(GTest REQUIRED)
  include(cmake/core_tests.cmake)
endif()
