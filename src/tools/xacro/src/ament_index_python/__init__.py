"""PyPI's xacro asks ROS 2's package index where a package is; here the answer comes from rospkg."""
