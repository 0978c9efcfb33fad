"""Parameters of a kind: what is of another kind is told in one line, and the default is used."""
from __future__ import annotations

import math
from typing import Any, Dict

import rospy

from moveit_core.errors import one_line


def table(name: str) -> Dict[str, Any]:
    """The parameter ``name`` as a table; empty when it is none."""
    value = rospy.get_param(name, {})
    if isinstance(value, dict):
        return value
    rospy.logerr("parameter %s is %s, where a table is expected: it is ignored", name, one_line(repr(value), 60))
    return {}


def number(where: str, value: Any, default: float) -> float:
    """``value``, found at ``where``, as a finite number."""
    if not isinstance(value, bool) and isinstance(value, (int, float)) and math.isfinite(value):
        return float(value)
    rospy.logerr("parameter %s is %s, where a number is expected: %g is used", where, one_line(repr(value), 40), default)
    return default


def joint_limits(name: str) -> Dict[str, Dict[str, Any]]:
    """The usable part of joint_limits.yaml: a table for each joint, numbers and has_... flags in it."""
    usable: Dict[str, Dict[str, Any]] = {}
    for joint, entry in table(name).items():
        if not isinstance(entry, dict):
            rospy.logerr("parameter %s/%s is %s, where a table of limits is expected: the URDF's count", name, joint,
                         one_line(repr(entry), 60))
            continue
        usable[joint] = {}
        for key, value in entry.items():
            flag = key.startswith("has_")
            if isinstance(value, bool) if flag else isinstance(value, (int, float)) and math.isfinite(value):
                usable[joint][key] = value
            elif flag or key.startswith(("max_", "min_")):
                rospy.logerr("parameter %s/%s/%s is %s, where %s is expected: it is ignored", name, joint, key,
                             one_line(repr(value), 40), "true or false" if flag else "a number")
    return usable
