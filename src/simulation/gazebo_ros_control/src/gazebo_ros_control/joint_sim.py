"""One simulated joint: its handles, and what each kind of command does to the joint in the world.

These run in every step of the world, so they avoid look-ups and calls.
"""
from __future__ import annotations

import math
from typing import Dict

from control_toolbox import Pid
from hardware_interface import JointHandle, JointStateHandle
from joint_limits_interface import JointDescription


class Mode:
    """How commands of one interface reach a joint. ``handle`` is what controllers write."""

    __slots__ = ("joint", "state", "handle", "limits", "e_stop")

    #: Whether wiring.py may do what ``write`` does.
    wired = False
    #: Whether the joint's effort is the load that its drive or motor bears, not a command.
    bears = False
    effort_limit = math.inf

    def __init__(self, joint, handle: JointHandle, limits):
        self.joint = joint          # ode_sim.JointHandle
        self.handle = handle
        self.state = handle.state
        self.limits = limits        # joint_limits_interface handle
        self.e_stop = False

    def enter(self) -> None:
        """This mode takes over; its handle gets a command that keeps the joint where it is, or free."""
        self.limits.reset()
        self.handle.command = 0.0

    def leave(self) -> None:
        """Another mode takes over."""

    def press(self, active: bool) -> None:
        """Emergency stop."""
        self.e_stop = active

    def write(self, dt: float) -> None:
        raise NotImplementedError


class EffortMode(Mode):
    """The command is the joint's force or torque; of a controller that closes a loop the law behind it is known too."""

    __slots__ = ("effort_limit",)

    wired = True

    def __init__(self, joint, handle: JointHandle, limits, effort_limit: float):
        super().__init__(joint, handle, limits)
        self.effort_limit = effort_limit

    def enter(self) -> None:
        super().enter()
        self.handle.slope = 0.0

    def write(self, dt: float) -> None:
        handle = self.handle
        wanted = handle.command
        self.limits.enforce_limits(dt)
        allowed = handle.command
        if self.e_stop:
            self.joint.add_force(0.0)
        elif handle.slope != 0.0 and (wanted == allowed or self.effort_limit <= abs(allowed) < abs(wanted) < math.inf):
            self.joint.add_law(wanted, handle.slope, self.effort_limit)
        else:  # what other limits made of the command is no law
            self.joint.add_force(allowed)
        self.state.effort = self.joint.effort()


class PositionMode(Mode):
    """The joint follows its position command exactly."""

    __slots__ = ("_frozen",)

    wired = bears = True

    def __init__(self, joint, handle: JointHandle, limits):
        super().__init__(joint, handle, limits)
        self._frozen = 0.0

    def enter(self) -> None:
        super().enter()
        self.handle.command = self.state.position

    def leave(self) -> None:
        self.joint.drive_off()
        self.state.effort = 0.0

    def press(self, active: bool) -> None:
        if active and not self.e_stop:
            self._frozen = self.state.position
        self.e_stop = active

    def target(self, dt: float) -> float:
        """The position to be at after this step."""
        if self.e_stop:
            self.handle.command = self._frozen
        self.limits.enforce_limits(dt)
        return self.handle.command

    def write(self, dt: float) -> None:
        if self.e_stop:  # as in target(), without the call
            self.handle.command = self._frozen
        self.limits.enforce_limits(dt)
        self.joint.drive_to(self.handle.command)


class _ByPid(Mode):
    """Before another mode among the base classes: ``_pid`` gives the joint's effort, within ``effort_limit``.

    What the PID would give at other speeds goes with it: the simulation holds gains that are too high for its step.
    """

    __slots__ = ()

    bears = False
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

    __slots__ = ("_pid", "_description", "effort_limit")

    wired = False

    def __init__(self, joint, handle: JointHandle, limits, pid: Pid, description: JointDescription,
                 effort_limit: float):
        super().__init__(joint, handle, limits)
        self._pid = pid
        self._description = description
        self.effort_limit = effort_limit

    def write(self, dt: float) -> None:
        error = self._description.error(self.joint.position(), self.target(dt))
        self.push(error, self._pid.slope_of_position(dt), dt)


class VelocityMode(Mode):
    """A motor keeps the commanded velocity, as far as the effort limit lets it."""

    __slots__ = ("effort_limit",)

    wired = bears = True

    def __init__(self, joint, handle: JointHandle, limits, effort_limit: float):
        super().__init__(joint, handle, limits)
        self.effort_limit = effort_limit

    def leave(self) -> None:
        self.joint.set_motor(0.0, 0.0)
        self.state.effort = 0.0

    def target(self, dt: float) -> float:
        """The velocity to have."""
        self.limits.enforce_limits(dt)
        return 0.0 if self.e_stop else self.handle.command

    def write(self, dt: float) -> None:
        self.joint.set_motor(self.target(dt), self.effort_limit)


class VelocityPidMode(_ByPid, VelocityMode):
    """A PID on the velocity gives the joint's effort."""

    __slots__ = ("_pid",)

    wired = False

    def __init__(self, joint, handle: JointHandle, limits, effort_limit: float, pid: Pid):
        super().__init__(joint, handle, limits, effort_limit)
        self._pid = pid

    def write(self, dt: float) -> None:
        self.push(self.target(dt) - self.joint.velocity(), self._pid.slope_of_velocity(dt), dt)


class JointSim:
    """A joint with the modes that its transmission lists; the first one is in force until a controller takes
    another."""

    __slots__ = ("name", "joint", "state", "modes", "mode")

    mode: Mode  #: in force; there is none before the first :meth:`add`

    def __init__(self, joint, state: JointStateHandle):
        self.name = state.name
        self.joint = joint
        self.state = state
        self.modes: Dict[str, Mode] = {}        # by C++ name of the interface

    def add(self, interface: str, mode: Mode) -> None:
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
