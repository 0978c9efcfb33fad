"""Angles out of messages."""

import math


def heading(orientation) -> float:
    """rad, of what stands upright. :param orientation: a unit quaternion with ``z`` and ``w``, as geometry_msgs has it"""
    return 2.0 * math.atan2(orientation.z, orientation.w)
