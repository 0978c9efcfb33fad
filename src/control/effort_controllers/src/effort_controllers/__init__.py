"""Controllers for joints that take effort commands."""

from .controllers import (
    JointEffortController,
    JointGroupEffortController,
    JointGroupPositionController,
    JointPositionController,
    JointVelocityController,
    PidPositionController,
)

__all__ = [
    "JointEffortController",
    "JointGroupEffortController",
    "JointGroupPositionController",
    "JointPositionController",
    "JointVelocityController",
    "PidPositionController",
]
