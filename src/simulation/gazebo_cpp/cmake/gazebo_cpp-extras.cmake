# ignition-math's headers are C++17; packages that say -std=c++11 by hand are raised to it.
if(NOT COMMAND noetic_raise_standard)
  string(REPLACE ":" ";" _gazebo_prefixes "$ENV{CMAKE_PREFIX_PATH}")
  find_file(NOETIC_OLD_STANDARDS old_standards.cmake PATHS ${CMAKE_PREFIX_PATH} ${_gazebo_prefixes}
    PATH_SUFFIXES share/catkin/cmake NO_DEFAULT_PATH)
  mark_as_advanced(NOETIC_OLD_STANDARDS)
  include("${NOETIC_OLD_STANDARDS}" OPTIONAL)
endif()
if(COMMAND noetic_raise_standard)
  noetic_raise_standard(17)
endif()
