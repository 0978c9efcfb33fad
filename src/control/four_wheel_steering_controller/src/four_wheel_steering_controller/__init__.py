"""Four steered and driven wheels: kinematics (ROS-free) and the controller."""
