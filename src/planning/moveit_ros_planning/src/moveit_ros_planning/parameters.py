"""Parameters of a kind: what is of another kind is told in one line, and the default is used."""

from __future__ import annotations

from typing import Any

import rospy
from moveit_core.errors import one_line
from node_signals.parameters import is_number


def table(name: str) -> dict[str, Any]:
    """The parameter ``name`` as a table; empty when it is none."""
    value = rospy.get_param(name, {})
    if isinstance(value, dict):
        return value
    rospy.logerr("parameter %s is %s, where a table is expected: it is ignored", name, one_line(repr(value), 60))
    return {}


def joint_limits(name: str) -> dict[str, dict[str, Any]]:
    """The usable part of joint_limits.yaml at parameter ``name``: a table of numbers and has_... flags for each joint, or
    ``joint/variable``.
    """
    return _limits(name, table(name))


def _limits(name: str, entries: dict[str, Any]) -> dict[str, dict[str, Any]]:
    usable: dict[str, dict[str, Any]] = {}
    for joint, entry in entries.items():
        if not isinstance(entry, dict):
            rospy.logerr(
                "parameter %s/%s is %s, where a table of limits is expected: the URDF's count", name, joint, one_line(repr(entry), 60)
            )
            continue
        variables = {key: value for key, value in entry.items() if isinstance(value, dict)}
        usable.update((f"{joint}/{key}", value) for key, value in _limits(f"{name}/{joint}", variables).items())
        if len(variables) == len(entry) > 0:
            continue
        usable[joint] = {}
        for key, value in entry.items():
            if key in variables:
                continue
            flag = key.startswith("has_")
            if isinstance(value, bool) if flag else is_number(value):
                usable[joint][key] = value
            elif flag or key.startswith(("max_", "min_")):
                rospy.logerr(
                    "parameter %s/%s/%s is %s, where %s is expected: it is ignored",
                    name,
                    joint,
                    key,
                    one_line(repr(value), 40),
                    "true or false" if flag else "a number",
                )
    return usable
