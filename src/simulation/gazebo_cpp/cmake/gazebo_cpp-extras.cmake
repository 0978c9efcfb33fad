# ignition-math's headers are C++17; packages that say -std=c++11 by hand are raised to it.
include("${CMAKE_CURRENT_LIST_DIR}/../../catkin/cmake/old_standards.cmake" OPTIONAL)
if(COMMAND noetic_raise_standard)
  noetic_raise_standard(17)
endif()
