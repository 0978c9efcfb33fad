"""Bags of ROS 1 as MCAP files and as bags of ROS 2, and back."""
