"""Gazebo Classic's C++ API over a simulated world; what the server asks of it is in ``gazebo_cpp._core``."""
