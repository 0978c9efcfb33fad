"""The ROS side of motion planning that nodes and clients share: robot descriptions, monitors, pipelines, execution."""
