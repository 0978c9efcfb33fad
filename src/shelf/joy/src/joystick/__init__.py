"""Joysticks of the Linux kernel (/dev/input/js*)."""
