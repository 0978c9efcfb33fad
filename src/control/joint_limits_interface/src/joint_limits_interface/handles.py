"""Handles that change a joint's command so that it keeps its limits. Called every cycle, before the hardware writes.

Each takes ``dt``, the s since the last cycle. The arithmetic avoids calls: these run for every joint, 1000 times a
second and more.
"""
from __future__ import annotations

import time
from math import inf, nan
from typing import Any, Dict

import rospy
from hardware_interface import ControlError, JointHandle

from .limits import JointLimits, SoftJointLimits

#: s between two warnings about the same joint
_WARN_PERIOD = 5.0


def _sat(value: float, low: float, high: float) -> float:
    return low if value < low else high if value > high else value


class JointLimitsError(ControlError):
    """A handle needs limits that the joint does not have."""


class _LimitHandle:
    __slots__ = ("joint", "limits", "_state", "_previous", "_warned")

    requires: "tuple[str, ...]" = ()
    #: Which of the rules of ode_sim's ``Wiring`` this is, that does for all joints of a robot in one call what the handles do one by one.
    rule: int

    def __init__(self, joint: JointHandle, limits: JointLimits):
        self.joint = joint
        self.limits = limits
        self._state = joint.state
        self._warned = -inf
        for kind in self.requires:
            if not getattr(limits, f"has_{kind}_limits"):
                raise JointLimitsError(f"Cannot enforce limits for joint '{joint.name}': it has no {kind} limits "
                                       f"specification")
        self.reset()

    @property
    def name(self) -> str:
        return self.joint.name

    def reset(self) -> None:
        """Forget the last command (after the robot was moved by other means)."""
        self._previous: Any = 0.0  # a number in all but the position handles

    def enforce_limits(self, dt: float) -> None:
        raise NotImplementedError

    @property
    def previous(self) -> float:
        """The command of the cycle before; NaN where the next one starts from the measured position."""
        return nan if self._previous is None else self._previous

    @previous.setter
    def previous(self, value: float) -> None:
        self._previous = value
        if value != value:
            self.reset()

    def numbers(self) -> "tuple[float, ...]":
        """Of the rule: lowest and highest position (hard limits), greatest velocity, acceleration and effort, lowest and highest position
        (soft limits), k_position, k_velocity; what it does not have is infinite, or 0."""
        def get(name: str, otherwise: float) -> float:
            return getattr(self, name, otherwise)

        return (get("_low", -inf), get("_high", inf), get("_velocity", inf), get("_acceleration", inf), get("_effort", inf),
                get("_soft_low", 0.0), get("_soft_high", 0.0), get("_gain", 0.0), 0.0)

    def instead(self, command: float, held: float) -> float:
        """What to command instead of something that is no number; warns."""
        now = time.monotonic()
        if now - self._warned >= _WARN_PERIOD:
            self._warned = now
            rospy.logwarn("Joint '%s' was commanded %s, which is no usable number; holding %g. Look at the controller "
                          "or the message that it was sent.", self.name, command, held)
        return held

    def _limit(self, low: float, high: float, held: float) -> None:
        """Put the command between ``low`` and ``high``; ``held`` takes the place of one that is no usable number."""
        command = self.joint.command
        output = low if command < low else command
        output = high if output > high else output
        if output - output != 0.0:  # NaN, or an infinity that no limit caught
            output = _sat(self.instead(command, held), low, high)
            if output - output != 0.0:  # the limits themselves are no numbers to be at
                output = held
        self.joint.command = self._previous = output

    @staticmethod
    def _velocity_bound(limits: JointLimits) -> float:
        return limits.max_velocity if limits.has_velocity_limits else inf


def _position_bounds(limits: JointLimits) -> "tuple[float, float]":
    return (limits.min_position, limits.max_position) if limits.has_position_limits else (-inf, inf)


class _PositionHandle(_LimitHandle):
    """``_previous`` is the last output; None until the first cycle, which starts from the measured position."""

    __slots__ = ()

    def reset(self) -> None:
        self._previous = None


class PositionJointSaturationHandle(_PositionHandle):
    """Keeps positions inside the limits and their steps within the velocity limit."""

    rule = 0
    __slots__ = ("_low", "_high", "_velocity")

    def __init__(self, joint: JointHandle, limits: JointLimits):
        super().__init__(joint, limits)
        self._low, self._high = _position_bounds(limits)
        self._velocity = self._velocity_bound(limits)

    def enforce_limits(self, dt: float) -> None:
        previous = self._previous
        if previous is None:
            previous = self._state.position
        step = self._velocity * dt
        low, high = previous - step, previous + step
        self._limit(low if low > self._low else self._low, high if high < self._high else self._high, previous)


class PositionJointSoftLimitsHandle(_PositionHandle):
    """Slows a joint down on its way to the soft limits, and keeps it inside the hard ones."""

    rule = 1
    __slots__ = ("_low", "_high", "_velocity", "_soft_low", "_soft_high", "_gain")
    requires = ("velocity",)

    def __init__(self, joint: JointHandle, limits: JointLimits, soft: SoftJointLimits):
        super().__init__(joint, limits)
        self._low, self._high = _position_bounds(limits)
        self._velocity = limits.max_velocity
        self._soft_low, self._soft_high = soft.min_position, soft.max_position
        self._gain = soft.k_position

    def enforce_limits(self, dt: float) -> None:
        previous = self._previous
        if previous is None:
            previous = self._state.position
        limit = self._velocity
        if self.limits.has_position_limits:
            slowest = _sat(-self._gain * (previous - self._soft_low), -limit, limit)
            fastest = _sat(-self._gain * (previous - self._soft_high), -limit, limit)
        else:
            slowest, fastest = -limit, limit
        low, high = previous + slowest * dt, previous + fastest * dt
        self._limit(low if low > self._low else self._low, high if high < self._high else self._high, previous)


class VelocityJointSaturationHandle(_LimitHandle):
    """Keeps velocities within the limit, and their steps within the acceleration limit if there is one."""

    rule = 2
    __slots__ = ("_velocity", "_acceleration")
    requires = ("velocity",)

    def __init__(self, joint: JointHandle, limits: JointLimits):
        super().__init__(joint, limits)
        self._velocity = limits.max_velocity
        self._acceleration = limits.max_acceleration if limits.has_acceleration_limits else inf

    def enforce_limits(self, dt: float) -> None:
        low, high = -self._velocity, self._velocity
        if self._acceleration < inf:
            step = self._acceleration * dt
            low, high = max(self._previous - step, low), min(self._previous + step, high)
        self._limit(low, high, self._previous)


class VelocityJointSoftLimitsHandle(_LimitHandle):
    """Slows a velocity-commanded joint down on its way to the soft position limits."""

    rule = 3
    __slots__ = ("_velocity", "_acceleration", "_soft_low", "_soft_high", "_gain")

    def __init__(self, joint: JointHandle, limits: JointLimits, soft: SoftJointLimits):
        super().__init__(joint, limits)
        self._velocity = self._velocity_bound(limits)
        self._acceleration = limits.max_acceleration if limits.has_acceleration_limits else inf
        self._soft_low, self._soft_high = soft.min_position, soft.max_position
        self._gain = soft.k_position

    def enforce_limits(self, dt: float) -> None:
        limit, state = self._velocity, self._state
        low, high = -limit, limit
        if self.limits.has_position_limits:
            low = _sat(-self._gain * (state.position - self._soft_low), -limit, limit)
            high = _sat(-self._gain * (state.position - self._soft_high), -limit, limit)
        if self._acceleration < inf:
            step = self._acceleration * dt
            low, high = max(state.velocity - step, low), min(state.velocity + step, high)
        self._limit(low, high, self._previous)


class EffortJointSaturationHandle(_LimitHandle):
    """Keeps efforts within the limit, and lets none push further out of the position or velocity limits."""

    rule = 4
    __slots__ = ("_low", "_high", "_velocity", "_effort")
    requires = ("velocity", "effort")

    def __init__(self, joint: JointHandle, limits: JointLimits):
        super().__init__(joint, limits)
        self._low, self._high = _position_bounds(limits)
        self._velocity = limits.max_velocity
        self._effort = limits.max_effort

    def enforce_limits(self, dt: float) -> None:
        state = self._state
        low, high = -self._effort, self._effort
        if state.position < self._low or state.velocity < -self._velocity:
            low = 0.0
        if state.position > self._high or state.velocity > self._velocity:
            high = 0.0
        self._limit(low, high, self._previous)


class EffortJointSoftLimitsHandle(_LimitHandle):
    """Brakes an effort-commanded joint on its way to the soft position limits."""

    rule = 5
    __slots__ = ("_velocity", "_effort", "_soft")
    requires = ("velocity", "effort")

    def __init__(self, joint: JointHandle, limits: JointLimits, soft: SoftJointLimits):
        super().__init__(joint, limits)
        self._velocity = limits.max_velocity
        self._effort = limits.max_effort
        self._soft = soft

    def numbers(self) -> "tuple[float, ...]":
        soft = self._soft
        return (-inf, inf, self._velocity, inf, self._effort, soft.min_position, soft.max_position, soft.k_position, soft.k_velocity)

    def enforce_limits(self, dt: float) -> None:
        state, soft, limit, effort = self._state, self._soft, self._velocity, self._effort
        slowest, fastest = -limit, limit
        if self.limits.has_position_limits:
            slowest = _sat(-soft.k_position * (state.position - soft.min_position), -limit, limit)
            fastest = _sat(-soft.k_position * (state.position - soft.max_position), -limit, limit)
        self._limit(_sat(-soft.k_velocity * (state.velocity - slowest), -effort, effort),
                    _sat(-soft.k_velocity * (state.velocity - fastest), -effort, effort), self._previous)


class JointLimitsInterface:
    """Limit handles of one kind, enforced together in the order of their joints' names."""

    def __init__(self) -> None:
        self._handles: Dict[str, _LimitHandle] = {}

    def register_handle(self, handle: _LimitHandle) -> None:
        self._handles[handle.name] = handle
        self._handles = dict(sorted(self._handles.items()))

    def names(self) -> "list[str]":
        return list(self._handles)

    def enforce_limits(self, dt: float) -> None:
        for handle in self._handles.values():
            handle.enforce_limits(dt)

    def reset(self) -> None:
        for handle in self._handles.values():
            handle.reset()
