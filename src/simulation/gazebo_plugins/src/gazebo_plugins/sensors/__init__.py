"""Sensors without pictures (ranges, inertia, contacts, wrenches, pose) and the hector_gazebo family."""
