"""Kalman filters that fuse a robot's sensors (T. Moore, D. Stouch: A generalized extended Kalman filter implementation for ROS, 2014)."""
