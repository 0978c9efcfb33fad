"""The orientation of a pose as a box in space, for rqt."""
