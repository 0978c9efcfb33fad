"""Driving from the keyboard: `driving` turns keys into velocities, `keyboard` reads them, `node` is the ROS node."""
