"""RoboMaster motors on CAN buses, driven through the ros_control stack.

Layers, each knowing only those above it:

``frames``, ``coefficients``, ``low_pass``
    plain conversions, no state but the filter's
``actuator``
    one motor: counts to SI units, turns, time-out
``can_bus``, ``serial_lines``
    frames in and out of an interface, reconnecting
``hardware``, ``loop``, ``node``
    the RobotHW, its 1 kHz loop, and the ROS node
``bench``
    motors that do not exist, behind a serial port that speaks SLCAN
"""
