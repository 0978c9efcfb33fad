"""The node pointcloud_to_laserscan_node: :mod:`.projection` without ROS, :mod:`.node` with it."""
