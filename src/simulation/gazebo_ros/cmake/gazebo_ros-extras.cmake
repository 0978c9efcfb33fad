# What upstream's package of this name depends on. tf brings tf2_ros, and that brings actionlib.
gazebo_bring_along(gazebo_ros dynamic_reconfigure roscpp roslib tf)
