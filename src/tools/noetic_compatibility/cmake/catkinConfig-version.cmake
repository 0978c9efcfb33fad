include(/usr/share/catkin/cmake/catkinConfig-version.cmake)
