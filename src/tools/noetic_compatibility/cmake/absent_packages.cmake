# What find_package(catkin REQUIRED COMPONENTS ...) says about a package that is not there: one paragraph in place of CMake's.

set(_noetic_anyway "The workspace's other packages build with `catkin build --continue-on-failure`, or without this one for good \
with `catkin config --skiplist PACKAGE`.")

# _noetic_absent(SENTENCE NAME...): what is known of packages that neither Debian nor this platform has.
macro(_noetic_absent sentence)
  foreach(_noetic_name ${ARGN})
    set(_noetic_absent_${_noetic_name} "${sentence}")
  endforeach()
endmacro()

set(_noetic_built "It is not supplied here, and Debian does not package it; build it from source \
in your workspace")
_noetic_absent("It belongs to the navigation stack, which is not supplied here and which Debian does not package; build it from \
source in your workspace (ros-planning/navigation, branch noetic-devel)."
  amcl base_local_planner carrot_planner clear_costmap_recovery costmap_2d dwa_local_planner fake_localization global_planner
  map_server move_base move_slow_and_clear nav_core navfn navigation rotate_recovery voxel_grid)
_noetic_absent("${_noetic_built} (ros-perception/slam_gmapping and ros-perception/openslam_gmapping)."
  gmapping openslam_gmapping slam_gmapping)
_noetic_absent("${_noetic_built} (tu-darmstadt-ros-pkg/hector_slam, branch noetic-devel)."
  hector_compressed_map_transport hector_geotiff hector_geotiff_launch hector_geotiff_plugins hector_imu_attitude_to_tf
  hector_map_server hector_map_tools hector_mapping hector_marker_drawing hector_nav_msgs hector_slam hector_slam_launch
  hector_trajectory_server)
_noetic_absent("${_noetic_built} (ros-planning/robot_pose_ekf)." robot_pose_ekf)
_noetic_absent("${_noetic_built} (hrnr/m-explore, branch noetic-devel)." explore_lite multirobot_map_merge)
_noetic_absent("${_noetic_built} (paulbovbel/frontier_exploration)."
  frontier_exploration exploration_msgs exploration_server polygon_layer)
_noetic_absent("${_noetic_built} (ros/executive_smach, branch noetic-devel)." executive_smach smach smach_msgs smach_ros)
_noetic_absent("${_noetic_built} (RobotWebTools/tf2_web_republisher)." tf2_web_republisher)
_noetic_absent("${_noetic_built} (AprilRobotics/apriltag_ros)." apriltag_ros)
_noetic_absent("${_noetic_built} (pal-robotics/aruco_ros, branch noetic-devel)." aruco aruco_msgs aruco_ros)
_noetic_absent("${_noetic_built} (machinekoder/ar_track_alvar, branch noetic-devel)." ar_track_alvar ar_track_alvar_msgs)
_noetic_absent("${_noetic_built} (ros-drivers/usb_cam, branch develop)." usb_cam)
_noetic_absent("${_noetic_built} (ros-drivers/audio_common, of which its folder sound_play is enough)." sound_play)
_noetic_absent("Noetic does not have it any more; build it from source in your workspace (ros-drivers/joystick_drivers, the commit before \
c471ff3, with Debian's libusb-dev)." ps3joy)
_noetic_absent("${_noetic_built} (ros-drivers/rosserial, branch noetic-devel)."
  rosserial rosserial_arduino rosserial_client rosserial_msgs rosserial_python rosserial_server)
_noetic_absent("${_noetic_built} (wjwwood/serial)." serial)
_noetic_absent("${_noetic_built} (stonier/ecl_core, branch release/0.62-noetic, ecl_lite and ecl_tools, branches release/0.61-noetic)."
  ecl_build ecl_concepts ecl_config ecl_errors ecl_exceptions ecl_mpl ecl_threads ecl_time ecl_time_lite ecl_type_traits ecl_utilities)
_noetic_absent("${_noetic_built} (yujinrobot/yujin_ocs; the smoother with stonier's ecl_core, ecl_lite and ecl_tools)."
  yocs_cmd_vel_mux yocs_velocity_smoother)
_noetic_absent("${_noetic_built} (Slamtec/rplidar_ros)." rplidar_ros)
_noetic_absent("${_noetic_built} (ROBOTIS-GIT/DynamixelSDK, branch noetic-devel)." dynamixel_sdk)
_noetic_absent("${_noetic_built} (ROBOTIS-GIT/dynamixel-workbench, branch noetic-devel, and what its packages need)."
  dynamixel_workbench dynamixel_workbench_controllers dynamixel_workbench_operators dynamixel_workbench_toolbox)
_noetic_absent("${_noetic_built} (rst-tu-dortmund/costmap_converter)." costmap_converter)
_noetic_absent("${_noetic_built} (pal-robotics/ddynamic_reconfigure, branch kinetic-devel)." ddynamic_reconfigure)
_noetic_absent("${_noetic_built} (ros/filters, branch noetic-devel)." filters)
_noetic_absent("${_noetic_built} (ros-perception/laser_assembler, branch noetic-devel)." laser_assembler)
_noetic_absent("${_noetic_built} (iralabdisco/ira_laser_tools)." ira_laser_tools)
_noetic_absent("${_noetic_built} (tu-darmstadt-ros-pkg/hector_localization)."
  hector_localization hector_pose_estimation hector_pose_estimation_core message_to_tf)
_noetic_absent("${_noetic_built} (CCNYRoboticsLab/imu_tools, branch noetic; its filters are supplied)." imu_tools rviz_imu_plugin)
_noetic_absent("${_noetic_built} (bitbucket.org/traclabs/trac_ik, version 1.6.6), with Debian's \
libnlopt-cxx-dev and swig. Without it MoveIt takes a solver of its own in its place."
  trac_ik trac_ik_examples trac_ik_kinematics_plugin trac_ik_lib trac_ik_python)
_noetic_absent("${_noetic_built} (ros-planning/warehouse_ros, branch kinetic-devel)." warehouse_ros)
_noetic_absent("${_noetic_built} (eric-wieser/ros_numpy)." ros_numpy)
_noetic_absent("${_noetic_built} (ros/common_tutorials, branch noetic-devel)." nodelet_tutorial_math pluginlib_tutorials)
_noetic_absent("${_noetic_built} (ros-visualization/visualization_tutorials, branch noetic-devel)."
  interactive_marker_tutorials librviz_tutorial rviz_python_tutorial visualization_marker_tutorials)
_noetic_absent("Its sources (ros-visualization/visualization_tutorials) declare Ogre::Vector3 as a class, which it is not in Debian's \
OGRE: in a copy of them replace the declaration by #include <OGRE/OgreVector3.h>." rviz_plugin_tutorials)
_noetic_absent("It needs g2o, which Debian does not package, and move_base_flex: build all three from source." teb_local_planner)
_noetic_absent("It makes maps or places robots in them, and is not supplied here; build it from source in your workspace."
  cartographer_ros slam_toolbox)
_noetic_absent("${_noetic_built} (ros-perception/slam_karto, open_karto and sparse_bundle_adjustment, branches melodic-devel)."
  open_karto slam_karto sparse_bundle_adjustment)
_noetic_absent("It is made for Gazebo Classic, whose C++ API is supplied (find_package(gazebo)): build it from source in your \
workspace." gazebo_ros_control_select_joints)
_noetic_absent("It is no package of catkin: find it by itself, without COMPONENTS." gazebo sdformat)
_noetic_absent("It is no package of catkin, on Noetic neither: take it out of COMPONENTS, and write find_package(OpenCV) beside it."
  opencv opencv2 opencv3)
_noetic_absent("${_noetic_built}." stage stage_ros)
_noetic_absent("${_noetic_built} (ros-visualization/rqt_robot_dashboard)." rqt_robot_dashboard)
_noetic_absent("${_noetic_built} (OTL/rqt_ez_publisher)." rqt_ez_publisher)
_noetic_absent("${_noetic_built} (stonier/rqt_py_trees)." rqt_py_trees)
_noetic_absent("${_noetic_built} (jsk-ros-pkg/jsk_visualization)." jsk_rqt_plugins)

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
