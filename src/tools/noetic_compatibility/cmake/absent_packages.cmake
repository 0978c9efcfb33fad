# What find_package(catkin REQUIRED COMPONENTS ...) says about a package that is not there: one paragraph in place of CMake's.

set(_noetic_anyway "The workspace's other packages build with `catkin build --continue-on-failure`, or without this one for good \
with `catkin config --skiplist PACKAGE`.")

# _noetic_absent(SENTENCE NAME...): what is known of packages that neither Debian nor this platform has.
macro(_noetic_absent sentence)
  foreach(_noetic_name ${ARGN})
    set(_noetic_absent_${_noetic_name} "${sentence}")
  endforeach()
endmacro()

_noetic_absent("It belongs to the navigation stack, which is not supplied here and which Debian does not package; build it from \
source in your workspace (ros-planning/navigation, branch noetic-devel)."
  amcl base_local_planner carrot_planner clear_costmap_recovery costmap_2d dwa_local_planner fake_localization global_planner
  map_server move_base move_slow_and_clear nav_core navfn navigation robot_pose_ekf rotate_recovery voxel_grid)
_noetic_absent("It is not supplied here, and Debian does not package it; build it from source in your workspace \
(ros-perception/slam_gmapping and ros-perception/openslam_gmapping)." gmapping openslam_gmapping slam_gmapping)
_noetic_absent("It makes maps or places robots in them, and is not supplied here; build it from source in your workspace."
  cartographer_ros hector_mapping hector_slam karto_slam slam_toolbox)
_noetic_absent("It is made for Gazebo Classic, whose C++ API is supplied (find_package(gazebo)): build it from source in your \
workspace." gazebo_ros_control_select_joints)
_noetic_absent("It is no package of catkin: find it by itself, without COMPONENTS." gazebo sdformat)
_noetic_absent("It belongs to the tutorials of desktop-full, is not supplied here, and builds from source in your workspace."
  nodelet_tutorial_math pluginlib_tutorials
  visualization_marker_tutorials librviz_tutorial rviz_plugin_tutorials stage stage_ros)
_noetic_absent("It is small, is not packaged by Debian, and builds from source in your workspace." costmap_converter ddynamic_reconfigure
  filters laser_assembler
  teb_local_planner smach smach_ros executive_smach
  serial rosserial rosserial_python rosbridge_server rosauth imu_tools warehouse_ros)

# _noetic_debian_packages(NAME VARIABLE): Debian's packages for a ROS package, from the rules that Debian ships for rosdep.
function(_noetic_debian_packages name variable)
  set(${variable} "" PARENT_SCOPE)
  if(EXISTS /usr/share/python3-rosdep2/debian.yaml)
    file(READ /usr/share/python3-rosdep2/debian.yaml rules)
    if("\n${rules}" MATCHES "\n${name}:\n  debian:\n((  - [^\n]+\n)+)")
      string(REGEX REPLACE "\n? *- " " " packages "${CMAKE_MATCH_1}")
      string(STRIP "${packages}" packages)
      set(${variable} "${packages}" PARENT_SCOPE)
    endif()
  endif()
endfunction()

# noetic_check_components(NAME...): ends the configuration at the first that no search path has.
function(noetic_check_components)
  set(prefixes ${CMAKE_PREFIX_PATH})
  if(NOT "$ENV{CMAKE_PREFIX_PATH}" STREQUAL "")
    string(REPLACE ":" ";" from_shell "$ENV{CMAKE_PREFIX_PATH}")
    list(APPEND prefixes ${from_shell})
  endif()
  list(APPEND prefixes /usr /usr/local)
  foreach(name ${ARGN})
    set(candidates)
    foreach(prefix ${prefixes})
      list(APPEND candidates ${prefix}/share/${name} ${prefix}/lib/cmake/${name} ${prefix}/lib/${name}
        ${prefix}/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/${name})
    endforeach()
    set(found FALSE)
    foreach(folder ${candidates})
      if(IS_DIRECTORY ${folder})
        set(found TRUE)
        break()
      endif()
    endforeach()
    if(found OR TARGET ${name} OR ${name}_DIR)
      continue()
    endif()
    find_package(${name} QUIET NO_MODULE)  # anywhere else that CMake knows of
    if(${name}_FOUND)
      continue()
    endif()
    _noetic_debian_packages(${name} debian)
    if(debian)
      set(what "Debian has it: sudo apt install ${debian}")
    elseif(DEFINED _noetic_absent_${name})
      set(what "${_noetic_absent_${name}}")
    else()
      set(what "If it is a package of your course, it has to stand in this workspace's src folder (and be built before: is \
it in <build_depend> or <depend> of package.xml?), or in a workspace that is sourced. `rosdep resolve ${name}` says whether \
Debian has it.")
    endif()
    message(FATAL_ERROR "The package '${name}', which ${PROJECT_NAME} asks for, is not here. ${what} ${_noetic_anyway}")
  endforeach()
endfunction()

# Repositories that bring gazebo_ros along, whose C++ is a part of Gazebo Classic itself: one sentence in place of the compiler's pages.
function(noetic_check_copies)
  if(EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/src/gazebo_ros_api_plugin.cpp")
    message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR} is a copy of gazebo_ros, whose C++ works in Gazebo Classic alone; this platform \
has a gazebo_ros of its own. Leave the copy out: touch ${CMAKE_CURRENT_SOURCE_DIR}/CATKIN_IGNORE")
  endif()
endfunction()
