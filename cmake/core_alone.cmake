# What is installed and tested where there is no ROS.

include(GNUInstallDirs)
install(TARGETS cloth_core cloth_run parameter_page
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
)
# Not to an installation of catkin.
#catkin_lint: ignore_once wrong_install_destination
install(DIRECTORY include/${PROJECT_NAME}/
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${PROJECT_NAME}
)

include(CTest)
if(BUILD_TESTING)
  find_package(GTest REQUIRED)
  include(cmake/core_tests.cmake)
endif()
