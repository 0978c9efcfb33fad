"""Handles that change a joint's command so that it keeps its limits. Called every cycle, before the hardware writes.

Their law is that of ``limit_law.h``, where the equations stand; C++'s handles have the same.
"""

from __future__ import annotations

import time
from math import inf
from typing import ClassVar

import rospy
from hardware_interface import ControlError, JointHandle

from ._limits import CommandLimiter
from .limits import JointLimits, SoftJointLimits

#: s between two warnings about the same joint
_WARN_PERIOD = 5.0


class JointLimitsError(ControlError):
    """A handle needs limits that the joint does not have."""


class _LimitHandle:
    """``law`` is this joint's own; what enforces it in this handle's stead calls :meth:`warn`."""

    __slots__ = ("joint", "limits", "law", "_state", "_warned")

    requires: tuple[str, ...] = ()
    kind: ClassVar[str]  #: of command

    def __init__(self, joint: JointHandle, limits: JointLimits, soft: SoftJointLimits | None = None):
        self.joint = joint
        self.limits = limits
        self._state = joint.state
        self._warned = -inf
        for kind in self.requires:
            if not getattr(limits, f"has_{kind}_limits"):
                raise JointLimitsError(f"Cannot enforce limits for joint '{joint.name}': it has no {kind} limits specification")
        self.law = CommandLimiter(self.kind, limits, soft)

    @property
    def name(self) -> str:
        return self.joint.name

    def reset(self) -> None:
        """Forget the last command (after the robot was moved by other means)."""
        self.law.reset()

    def enforce_limits(self, dt: float) -> None:
        """:param dt: s since the last cycle"""
        joint, state = self.joint, self._state
        command = joint.command
        joint.command, usable = self.law.enforce(command, state.position, state.velocity, dt)
        if not usable:
            self.warn(command)

    def warn(self, command: float) -> None:
        """What was commanded is no usable number, and was replaced."""
        now = time.monotonic()
        if now - self._warned >= _WARN_PERIOD:
            self._warned = now
            rospy.logwarn(
                "Joint '%s' was commanded %s, which is no usable number; holding %g. Look at the controller "
                "or the message that it was sent.",
                self.name,
                command,
                self.joint.command,
            )


class _SoftLimitHandle(_LimitHandle):
    __slots__ = ()

    def __init__(self, joint: JointHandle, limits: JointLimits, soft: SoftJointLimits):
        super().__init__(joint, limits, soft)


class PositionJointSaturationHandle(_LimitHandle):
    """Keeps positions inside the limits and their steps within the velocity limit."""

    __slots__ = ()
    kind = "position"


class PositionJointSoftLimitsHandle(_SoftLimitHandle):
    """Slows a joint down on its way to the soft limits, and keeps it inside the hard ones."""

    __slots__ = ()
    kind = "position"
    requires = ("velocity",)


class VelocityJointSaturationHandle(_LimitHandle):
    """Keeps velocities within the limit, and their steps within the acceleration limit if there is one."""

    __slots__ = ()
    kind = "velocity"
    requires = ("velocity",)


class VelocityJointSoftLimitsHandle(_SoftLimitHandle):
    """Slows a velocity-commanded joint down on its way to the soft position limits."""

    __slots__ = ()
    kind = "velocity"


class EffortJointSaturationHandle(_LimitHandle):
    """Keeps efforts within the limit, and lets none push further out of the position or velocity limits."""

    __slots__ = ()
    kind = "effort"
    requires = ("velocity", "effort")


class EffortJointSoftLimitsHandle(_SoftLimitHandle):
    """Brakes an effort-commanded joint on its way to the soft position limits."""

    __slots__ = ()
    kind = "effort"
    requires = ("velocity", "effort")


class JointLimitsInterface:
    """Limit handles of one kind, enforced together in the order of their joints' names."""

    def __init__(self) -> None:
        self._handles: dict[str, _LimitHandle] = {}

    def register_handle(self, handle: _LimitHandle) -> None:
        """Enforce ``handle`` too; a second one for the same joint replaces the first."""
        self._handles[handle.name] = handle
        self._handles = dict(sorted(self._handles.items()))

    def names(self) -> list[str]:
        return list(self._handles)

    def enforce_limits(self, dt: float) -> None:
        """Bring the commands of all handles within their limits; ``dt``: s since the cycle before."""
        for handle in self._handles.values():
            handle.enforce_limits(dt)

    def reset(self) -> None:
        for handle in self._handles.values():
            handle.reset()
