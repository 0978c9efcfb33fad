"""What descriptions and parameters make of limits: inputs, what changes, and why. Expected values are those of ros_control's
joint_limits_interface (noetic: joint_limits_urdf.h, joint_limits_rosparam.h); where nothing can be kept within a limit, what
limit_sources.h says. Both faces run these tables.
"""

from math import inf, nan
from typing import Any

from joint_limits_interface import JointLimits

BEFORE = JointLimits(
    has_position_limits=True,
    min_position=-3.0,
    max_position=3.0,
    has_velocity_limits=True,
    max_velocity=1.0,
    has_acceleration_limits=True,
    max_acceleration=5.0,
    has_jerk_limits=True,
    max_jerk=7.0,
)
RANGE = {"min_position": -1.0, "max_position": 2.0}
SOFT = {"has_soft_limits": True, "soft_lower_limit": -1, "soft_upper_limit": 1.0, "k_position": 2.0, "k_velocity": 3.0}

#: (why, parameters, what becomes different)
PARAMETERS: list[tuple[str, dict[str, Any], dict[str, Any]]] = [
    ("nothing said", {}, {}),
    ("a value", {"has_velocity_limits": True, "max_velocity": 2.5}, {"max_velocity": 2.5}),
    ("a whole number", {"has_velocity_limits": True, "max_velocity": 2}, {"max_velocity": 2.0}),
    ("a kind that the description lacks", {"has_effort_limits": True, "max_effort": 9.0}, {"has_effort_limits": True, "max_effort": 9.0}),
    ("an acceleration", {"has_acceleration_limits": True, "max_acceleration": 0.5}, {"max_acceleration": 0.5}),
    ("a jerk", {"has_jerk_limits": True, "max_jerk": 0.5}, {"max_jerk": 0.5}),
    ("no flag: ignored", {"max_velocity": 2.0}, {}),
    ("a flag without its value: as before", {"has_velocity_limits": True}, {}),
    ("a flag without its value, where there was none", {"has_effort_limits": True}, {}),
    ("a limit taken away keeps its value", {"has_velocity_limits": False, "max_velocity": 2.0}, {"has_velocity_limits": False}),
    ("a jerk taken away", {"has_jerk_limits": False}, {"has_jerk_limits": False}),
    ("an acceleration taken away", {"has_acceleration_limits": False}, {"has_acceleration_limits": False}),
    ("a flag that is a word", {"has_velocity_limits": "true", "max_velocity": 2.0}, {}),
    ("a flag that is a number", {"has_velocity_limits": 1, "max_velocity": 2.0}, {}),
    ("half a range", {"has_position_limits": True, "min_position": -1.0}, {}),
    ("the other half", {"has_position_limits": True, "max_position": 1.0}, {}),
    ("a range", {"has_position_limits": True, **RANGE}, RANGE),
    (
        "the wrong way round",
        {"has_position_limits": True, "min_position": 1, "max_position": -1},
        {"min_position": 1.0, "max_position": -1.0},
    ),
    ("endless", {"has_position_limits": False, "angle_wraparound": True}, {"has_position_limits": False, "angle_wraparound": True}),
    ("endless beside a range", {"has_position_limits": True, "angle_wraparound": True, **RANGE}, RANGE),
    ("endless without a flag", {"angle_wraparound": True}, {}),
    ("a word for a number", {"has_effort_limits": True, "max_effort": "a lot"}, {}),
    ("a flag for a number", {"has_velocity_limits": True, "max_velocity": True}, {}),
    ("a list for a number", {"has_velocity_limits": True, "max_velocity": [2.0]}, {}),
    ("infinitely fast", {"has_velocity_limits": True, "max_velocity": inf}, {"max_velocity": inf}),
    ("nothing can be kept within: velocity", {"has_velocity_limits": True, "max_velocity": -inf}, {}),
    ("nothing can be kept within: lower", {"has_position_limits": True, "min_position": inf, "max_position": inf}, {}),
    ("nothing can be kept within: upper", {"has_position_limits": True, "min_position": -inf, "max_position": -inf}, {}),
    ("no number", {"has_velocity_limits": True, "max_velocity": nan}, {}),
    ("half a number", {"has_position_limits": True, "min_position": nan, "max_position": 1.0}, {}),
    ("no number for a jerk", {"has_jerk_limits": True, "max_jerk": nan}, {}),
    ("a name that is none", {"has_speed_limits": True, "max_speed": 1.0}, {}),
    (
        "all at once",
        {
            "has_position_limits": True,
            **RANGE,
            "has_velocity_limits": True,
            "max_velocity": 4,
            "has_acceleration_limits": False,
            "has_jerk_limits": True,
            "max_jerk": 1.5,
            "has_effort_limits": True,
            "max_effort": 30.0,
        },
        {**RANGE, "max_velocity": 4.0, "has_acceleration_limits": False, "max_jerk": 1.5, "has_effort_limits": True, "max_effort": 30.0},
    ),
]

#: (why, parameters, least and greatest position and both gains, or None)
SOFT_PARAMETERS: list[tuple[str, dict[str, Any], tuple[float, ...] | None]] = [
    ("all there", SOFT, (-1.0, 1.0, 2.0, 3.0)),
    ("switched off", {**SOFT, "has_soft_limits": False}, None),
    ("no flag", {name: value for name, value in SOFT.items() if name != "has_soft_limits"}, None),
    *((f"without {left}", {name: value for name, value in SOFT.items() if name != left}, None) for left in list(SOFT)[1:]),
    ("a word", {**SOFT, "k_velocity": "3"}, None),
    ("no number", {**SOFT, "k_position": nan}, None),
    ("an endless window", {**SOFT, "soft_lower_limit": -inf, "soft_upper_limit": inf}, (-inf, inf, 2.0, 3.0)),
]

SPEED = {"has_velocity_limits": True, "max_velocity": 4.0, "has_effort_limits": True, "max_effort": 8.0, "has_acceleration_limits": False}
UNBOUNDED = {**SPEED, "has_position_limits": False}

#: (type of the joint, lower, upper, velocity and effort of its <limit>, what becomes different)
DESCRIPTIONS: list[tuple[str, tuple[float, float, float, float], dict[str, Any]]] = [
    ("revolute", (-1.0, 2.0, 4.0, 8.0), {**SPEED, **RANGE}),
    ("prismatic", (-1.0, 2.0, 4.0, 8.0), {**SPEED, **RANGE}),
    ("revolute", (0.0, 0.0, 4.0, 8.0), {**SPEED, "min_position": 0.0, "max_position": 0.0}),
    ("revolute", (2.0, -1.0, 4.0, 8.0), {**SPEED, "min_position": 2.0, "max_position": -1.0}),
    ("continuous", (-1.0, 2.0, 4.0, 8.0), {**UNBOUNDED, "angle_wraparound": True}),
    ("continuous", (0.0, 0.0, 0.0, 0.0), {**UNBOUNDED, "max_velocity": 0.0, "max_effort": 0.0, "angle_wraparound": True}),
    ("fixed", (-1.0, 2.0, 4.0, 8.0), UNBOUNDED),
    ("planar", (-1.0, 2.0, 4.0, 8.0), UNBOUNDED),
    ("floating", (-1.0, 2.0, 4.0, 8.0), UNBOUNDED),
]
