"""What an entry of ``controller_list`` says beyond its name and joints: tolerances, numbers, flags.

``controller_entries.cpp`` of moveit_ros_planning reads the same entries for C++; its ``test/tolerances.yaml`` holds for both.
"""

from __future__ import annotations

import math
from typing import Any

import rospy
from control_msgs.msg import JointTolerance
from moveit_core.errors import one_line

_QUANTITIES = ("position", "velocity", "acceleration")


def number(entry: dict[str, Any], key: str) -> float:
    """The number ``key`` of a controller's ``entry``; 0 where there is none, and an error line where it is something else."""
    value = entry.get(key, 0.0)
    if _is_number(value) and math.isfinite(value):
        return float(value)
    _tell(entry, key, f"is no number ({one_line(repr(value), 60)})")
    return 0.0


def flag(entry: dict[str, Any], key: str) -> bool:
    """Whether ``entry`` has ``key`` with anything but false or 0."""
    return key in entry and not (isinstance(entry[key], (bool, int)) and not entry[key])


def tolerances(entry: dict[str, Any], key: str) -> list[JointTolerance]:
    """The tolerances ``key`` of a controller's ``entry``, by the names of joints.

    They are a table of position, velocity and acceleration, each one number for all joints or a list in the order of the entry's
    ``joints``; or a list of tables with the ``name`` of a joint. What is neither is told in one line and is 0: the controller's own.
    """
    rows: dict[str, JointTolerance] = {}
    given = entry.get(key, [])
    if isinstance(given, dict):
        for quantity in [q for q in _QUANTITIES if q in given]:
            for joint, value in zip(entry["joints"], _of_joints(entry, key, quantity, given[quantity])):
                setattr(rows.setdefault(joint, JointTolerance(name=joint)), quantity, value)
    elif isinstance(given, list):
        for index, row in enumerate(given):
            if not isinstance(row, dict) or not isinstance(row.get("name"), str):
                _tell(entry, f"{key}[{index}]", "needs the 'name' of a joint")
                continue
            made = rows.setdefault(row["name"], JointTolerance(name=row["name"]))
            for quantity in [q for q in _QUANTITIES if q in row]:
                setattr(made, quantity, _one(entry, f"{key}[{index}]: {quantity}", row[quantity]))
    else:
        _tell(entry, key, "is neither a table of position, velocity and acceleration nor a list of tables with a 'name'")
    return [rows[joint] for joint in sorted(rows)]


def _of_joints(entry: dict[str, Any], key: str, quantity: str, given: Any) -> list[float]:
    joints, place = entry["joints"], f"{key}: {quantity}"
    if not isinstance(given, list):
        return [_one(entry, place, given)] * len(joints)
    if len(given) != len(joints):
        _tell(entry, place, f"has {len(given)} numbers, but the controller {len(joints)} joints")
        return [0.0] * len(joints)
    return [_one(entry, place, value) for value in given]


def _one(entry: dict[str, Any], place: str, value: Any) -> float:
    if _is_number(value):
        return float(value)
    _tell(entry, place, f"is no number ({one_line(repr(value), 60)})")
    return 0.0


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _tell(entry: dict[str, Any], place: str, problem: str) -> None:
    rospy.logerr("controller_list: %s of controller '%s' %s: it is not used", place, entry.get("name", ""), problem)
