"""Parameters of rospy nodes, read with a word for what is wrong with them."""
import math

import rospy


def number(name: str, default: float, least: float = -math.inf) -> float:
    """
    :param name: as for rospy.get_param. :param least: the smallest that is allowed.
    :raises ValueError: it is no number, or too small; says which parameter, what it is, what it must be.
    """
    value = rospy.get_param(name, default)
    if type(value) in (int, float) and math.isfinite(value) and value >= least:
        return float(value)
    bound = "" if least == -math.inf else f", {least:g} or more"
    raise ValueError(f"parameter {rospy.resolve_name(name)} must be a number{bound}, but is {value!r:.40}")
