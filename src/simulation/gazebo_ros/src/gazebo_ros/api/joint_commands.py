"""Joints driven from a window: a steady force, or a position or velocity held by effort, as in Gazebo's joint panel."""

from __future__ import annotations

from dataclasses import dataclass

from ode_sim import JointHandle

from gazebo_ros.api.handlers import Refused, advertise, finite
from gazebo_ros.callbacks import Occasional
from gazebo_ros.server import Server
from gazebo_ros.srv import CommandJoint, CommandJointRequest

_MODES = {
    CommandJointRequest.NONE: "none",
    CommandJointRequest.FORCE: "force",
    CommandJointRequest.POSITION: "position",
    CommandJointRequest.VELOCITY: "velocity",
    CommandJointRequest.SET: "set",
}


@dataclass
class JointDrive:
    """What acts on one joint before each step."""

    joint: JointHandle
    mode: str
    value: float
    p: float = 0.0
    i: float = 0.0
    d: float = 0.0
    error_sum: float = 0.0
    last_error: float | None = None

    def apply(self, dt: float) -> None:
        """:param dt: s of sim time since the last step."""
        if self.mode == "force":
            self.joint.add_force(self.value)
            return
        error = self.value - (self.joint.position() if self.mode == "position" else self.joint.velocity())
        slope = 0.0 if self.last_error is None else (error - self.last_error) / dt
        self.error_sum += error * dt
        self.last_error = error
        self.joint.add_force(self.p * error + self.i * self.error_sum + self.d * slope)


class JointCommands:
    """``~command_joint``. Nothing is done in a step while no joint is driven."""

    def __init__(self, server: Server):
        self._server = server
        self._drives: dict[str, JointDrive] = {}
        self._driving = Occasional(server.before_step, self._on_step)
        self._time_ns = 0
        server.world.on_remove.append(self._on_remove)
        advertise(server, "command_joint", CommandJoint, self._command)

    def _command(self, request, response) -> str:
        joint = self._server.world.find_joint(request.joint_name)
        if joint is None:
            raise Refused(f"joint [{request.joint_name}] not found; name it as model::joint")
        if not joint.axis_count:
            raise Refused(f"joint [{joint.scoped_name}] is fixed; it cannot be moved")
        if request.mode not in _MODES:
            raise Refused(f"mode {request.mode} is none of 0 (none), 1 (force), 2 (position), 3 (velocity), 4 (set)")
        finite("the request", request.value, request.p, request.i, request.d)
        mode = _MODES[request.mode]
        self._drives.pop(joint.scoped_name, None)
        if mode == "set":
            joint.set_position(request.value)
        elif mode != "none":
            self._drives[joint.scoped_name] = JointDrive(joint, mode, request.value, request.p, request.i, request.d)
        self._connect()
        return f"CommandJoint: {joint.scoped_name} {mode}"

    def _connect(self) -> None:
        if not self._driving.connected:
            self._time_ns = self._server.world.time_ns
        self._driving.needed(bool(self._drives))

    def _on_step(self) -> None:
        now = self._server.world.time_ns
        dt, self._time_ns = (now - self._time_ns) * 1e-9, now
        if dt <= 0.0:  # the time was reset, and so are the joints
            self._drives.clear()
            self._connect()
            return
        for drive in self._drives.values():
            drive.apply(dt)

    def _on_remove(self, model) -> None:
        for name in [name for name, drive in self._drives.items() if drive.joint.model is model]:
            del self._drives[name]
        self._connect()
