#error "there is no transport of Gazebo between processes here: a program cannot be its client; use topics of ROS"
