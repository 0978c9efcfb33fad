"""Filters of laser scans, and chains of them, under the names and parameters of laser_filters."""
