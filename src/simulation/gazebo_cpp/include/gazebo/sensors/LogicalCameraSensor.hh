#error \
    "gazebo::sensors::LogicalCameraSensor is not here in C++: rays, contacts, IMU, GPS, altimeter and magnetometer are; in Python it can be written (gazebo_ros.plugin)"
