"""Velocities from a joystick."""
