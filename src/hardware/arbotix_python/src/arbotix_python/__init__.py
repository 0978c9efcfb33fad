"""Driver for ArbotiX boards: `arbotix` talks to one, `driver` is the ROS node."""
