#error "no sensors of Gazebo in C++ here: a plugin of a sensor cannot be built; in Python it can (gazebo_ros.plugin)"
