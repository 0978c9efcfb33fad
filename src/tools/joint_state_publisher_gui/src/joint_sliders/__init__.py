"""Debian's window of joint_state_publisher_gui, with what it lacks."""
