# Packages that name gazebo_dev or gazebo_ros have the variables of find_package(gazebo), too.
find_package(gazebo QUIET PATHS "${CMAKE_CURRENT_LIST_DIR}/../../gazebo/cmake")

# gazebo_bring_along(NAME PACKAGE...): who names NAME alone has the headers and libraries of PACKAGEs as well, as far as this system
# has them. They are no CATKIN_DEPENDS, as packages without C++ configure where they are not installed.
function(gazebo_bring_along name)
  foreach(package IN LISTS ARGN)
    find_package(${package} QUIET)
    if(${package}_FOUND)
      foreach(what INCLUDE_DIRS LIBRARIES LIBRARY_DIRS EXPORTED_TARGETS)
        list(APPEND ${name}_${what} ${${package}_${what}})
      endforeach()
    endif()
  endforeach()
  list(REMOVE_DUPLICATES ${name}_INCLUDE_DIRS)
  foreach(what INCLUDE_DIRS LIBRARIES LIBRARY_DIRS EXPORTED_TARGETS)
    set(${name}_${what} ${${name}_${what}} PARENT_SCOPE)
  endforeach()
endfunction()
