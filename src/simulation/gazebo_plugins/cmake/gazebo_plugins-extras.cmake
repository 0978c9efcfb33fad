# What upstream's package of this name depends on.
gazebo_bring_along(gazebo_plugins angles camera_info_manager dynamic_reconfigure gazebo_msgs geometry_msgs image_transport nav_msgs
  nodelet roscpp rosconsole rosgraph_msgs sensor_msgs std_msgs std_srvs tf tf2_ros trajectory_msgs urdf)
