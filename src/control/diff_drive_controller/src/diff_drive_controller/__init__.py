"""Differential drive, and what all wheeled bases share.

``wheeled_base`` (life-cycle, cmd_vel to limited command, odometry) <- ``command_topic`` (commands with watchdog),
``odometry_publisher`` (odom and tf), ``speed_limiter`` and ``odometry`` (which know no ROS). They serve
ackermann_steering_controller and four_wheel_steering_controller as well.
"""
