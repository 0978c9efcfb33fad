"""Differential drive, and what all wheeled bases share.

``speed_limiter`` and ``odometry`` know no ROS; ``velocity_command`` (cmd_vel with watchdog), ``odometry_publisher``
(odom and tf) and the first two are used by ackermann_steering_controller and four_wheel_steering_controller as well.
"""
