#error \
    "lights of what is drawn are not here in C++: the service /gazebo/set_light_properties changes them, and a plugin in Python can (gazebo_ros.plugin)"
