"""One simulated joint: its handles, and what begins and ends with each kind of command to the joint in the world.

``core/wiring.cpp`` gives plain commands to the joint in every step; where a PID stands between, its mode does.
"""

from __future__ import annotations

import math

from control_toolbox import Pid
from hardware_interface import JointHandle, JointStateHandle
from joint_limits_interface import JointDescription


class Mode:
    """How commands of one interface reach a joint. ``handle`` is what controllers write."""

    __slots__ = ("joint", "state", "handle", "limits", "e_stop")

    #: Whether wiring.py writes the commands; else ``write`` does.
    wired = True
    #: Whether the joint's effort is the load that its drive or motor bears, not a command.
    bears = False
    effort_limit = math.inf

    def __init__(self, joint, handle: JointHandle, limits):
        self.joint = joint  # ode_sim.JointHandle
        self.handle = handle
        self.state = handle.state
        self.limits = limits  # joint_limits_interface handle
        self.e_stop = False

    def enter(self) -> None:
        """This mode takes over; its handle gets a command that keeps the joint where it is, or free."""
        self.limits.reset()
        self.handle.command = 0.0

    def leave(self) -> None:
        """Another mode takes over."""

    def press(self, active: bool) -> None:
        """Emergency stop: it is pressed (``active``), or let go."""
        self.e_stop = active

    def write(self, dt: float) -> None:
        """To the joint; of modes that are not wired. :param dt: s since the last time"""
        raise NotImplementedError


class EffortMode(Mode):
    """The command is the joint's force or torque; of a controller that closes a loop the law behind it is known too."""

    __slots__ = ("effort_limit",)

    def __init__(self, joint, handle: JointHandle, limits, effort_limit: float):
        super().__init__(joint, handle, limits)
        self.effort_limit = effort_limit

    def enter(self) -> None:
        super().enter()
        self.handle.slope = 0.0


class PositionMode(Mode):
    """The joint follows its position command exactly."""

    __slots__ = ()

    bears = True

    def enter(self) -> None:
        super().enter()
        self.handle.command = self.state.position

    def leave(self) -> None:
        self.joint.drive_off()
        self.state.effort = 0.0


class _ByPid(Mode):
    """Before another mode among the base classes: ``_pid`` gives the joint's effort, within ``effort_limit``.

    What the PID would give at other speeds goes with it: the simulation holds gains that are too high for its step.
    """

    __slots__ = ()

    wired = bears = False
    _pid: Pid

    def enter(self) -> None:
        super().enter()
        self._pid.reset()

    def leave(self) -> None:
        self.state.effort = 0.0

    def push(self, error: float, slope: float, dt: float) -> None:
        """Apply what the PID says to this error."""
        self.joint.add_law(self._pid.compute_command(error, dt), slope, self.effort_limit)
        self.state.effort = self.joint.effort()


class PositionPidMode(_ByPid, PositionMode):
    """A PID on the position gives the joint's effort."""

    __slots__ = ("_pid", "_description", "_frozen", "effort_limit")

    def __init__(self, joint, handle: JointHandle, limits, pid: Pid, description: JointDescription, effort_limit: float):
        super().__init__(joint, handle, limits)
        self._pid = pid
        self._description = description
        self._frozen = 0.0
        self.effort_limit = effort_limit

    def press(self, active: bool) -> None:
        if active and not self.e_stop:
            self._frozen = self.state.position
        super().press(active)

    def write(self, dt: float) -> None:
        if self.e_stop:
            self.handle.command = self._frozen
        self.limits.enforce_limits(dt)
        error = self._description.error(self.joint.position(), self.handle.command)
        self.push(error, self._pid.slope_of_position(dt), dt)


class VelocityMode(Mode):
    """A motor keeps the commanded velocity, as far as the effort limit lets it."""

    __slots__ = ("effort_limit",)

    bears = True

    def __init__(self, joint, handle: JointHandle, limits, effort_limit: float):
        super().__init__(joint, handle, limits)
        self.effort_limit = effort_limit

    def leave(self) -> None:
        self.joint.set_motor(0.0, 0.0)
        self.state.effort = 0.0


class VelocityPidMode(_ByPid, VelocityMode):
    """A PID on the velocity gives the joint's effort."""

    __slots__ = ("_pid",)

    def __init__(self, joint, handle: JointHandle, limits, effort_limit: float, pid: Pid):
        super().__init__(joint, handle, limits, effort_limit)
        self._pid = pid

    def write(self, dt: float) -> None:
        self.limits.enforce_limits(dt)
        wanted = 0.0 if self.e_stop else self.handle.command
        self.push(wanted - self.joint.velocity(), self._pid.slope_of_velocity(dt), dt)


class JointSim:
    """A joint with the modes that its transmission lists; the first one is in force until a controller takes
    another."""

    __slots__ = ("name", "joint", "state", "modes", "mode")

    mode: Mode  #: in force; there is none before the first :meth:`add`

    def __init__(self, joint, state: JointStateHandle):
        self.name = state.name
        self.joint = joint
        self.state = state
        self.modes: dict[str, Mode] = {}  # by C++ name of the interface

    def add(self, interface: str, mode: Mode) -> None:
        """Let the joint be commanded through ``interface``, a C++ name, as ``mode`` does it; the first one is in force."""
        if not self.modes:
            self.mode = mode
        self.modes[interface] = mode

    def switch(self, interface: str) -> bool:
        """Controllers now command through ``interface``. :returns: whether they did not before."""
        mode = self.modes[interface]
        if mode is self.mode:
            return False
        self.mode.leave()
        mode.enter()
        mode.press(self.mode.e_stop)
        self.mode = mode
        return True
