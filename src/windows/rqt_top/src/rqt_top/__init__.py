"""Processes of ROS nodes, for rqt."""
