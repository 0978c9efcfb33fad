"""Tabs that speak ROS."""
