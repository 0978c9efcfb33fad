"""Grippers of one or two bus servos."""
