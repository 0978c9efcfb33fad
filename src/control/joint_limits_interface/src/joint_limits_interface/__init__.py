"""Joint limits: where they come from (URDF, parameters), and handles that enforce them on commands.

Units: rad or m, and per s; Nm or N. A command that is not a number never gets through a handle: the last good one is
held, with one throttled warning.
"""

from ._limits import CommandLimiter
from .angles import distance_within_limits, normalize_angle, shortest_angular_distance
from .handles import (
    EffortJointSaturationHandle,
    EffortJointSoftLimitsHandle,
    JointLimitsError,
    JointLimitsInterface,
    PositionJointSaturationHandle,
    PositionJointSoftLimitsHandle,
    VelocityJointSaturationHandle,
    VelocityJointSoftLimitsHandle,
)
from .limits import JointLimits, SoftJointLimits, limits_from_params, limits_from_urdf, soft_limits_from_params, soft_limits_from_urdf
from .robot_description import DescriptionError, JointDescription, read_joints

__all__ = [
    "CommandLimiter",
    "DescriptionError",
    "EffortJointSaturationHandle",
    "EffortJointSoftLimitsHandle",
    "JointDescription",
    "JointLimits",
    "JointLimitsError",
    "JointLimitsInterface",
    "PositionJointSaturationHandle",
    "PositionJointSoftLimitsHandle",
    "SoftJointLimits",
    "VelocityJointSaturationHandle",
    "VelocityJointSoftLimitsHandle",
    "distance_within_limits",
    "limits_from_params",
    "limits_from_urdf",
    "normalize_angle",
    "read_joints",
    "shortest_angular_distance",
    "soft_limits_from_params",
    "soft_limits_from_urdf",
]
