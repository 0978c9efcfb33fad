"""Differential drive, and what all wheeled bases share.

``wheeled_base`` (life-cycle, cmd_vel to limited command, odometry) <- ``command_topic`` (commands with watchdog),
``odometry_publisher`` (odom and tf), ``speed_limiter`` (from parameters), ``laws`` (odometry and limits, in C++: they know
no ROS). They serve ackermann_steering_controller and four_wheel_steering_controller as well.
"""
