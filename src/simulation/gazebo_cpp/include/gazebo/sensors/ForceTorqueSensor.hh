#error \
    "gazebo::sensors::ForceTorqueSensor is not here in C++: rays, contacts, IMU, GPS, altimeter, magnetometer, sonar and logical camera are; in Python it can be written (gazebo_ros.plugin)"
