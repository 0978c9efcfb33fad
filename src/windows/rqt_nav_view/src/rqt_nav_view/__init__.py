"""Map, paths and footprint of a robot, for rqt."""
