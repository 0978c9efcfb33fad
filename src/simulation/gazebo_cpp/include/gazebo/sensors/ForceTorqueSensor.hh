#error "gazebo::sensors::ForceTorqueSensor is not here in C++; in Python it can be written (gazebo_ros.plugin)"
