#error \
    "there is no rendering of Gazebo here: a plugin that reads cameras in C++ cannot be built; in Python it can (gazebo_ros.plugin)"
