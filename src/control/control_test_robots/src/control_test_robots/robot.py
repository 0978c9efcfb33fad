"""Joints that do exactly what they are told, unless a test gives them a fault."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from typing import Any

from hardware_interface import (
    EffortJointInterface,
    ForceTorqueSensorHandle,
    ForceTorqueSensorInterface,
    ImuSensorHandle,
    ImuSensorInterface,
    JointHandle,
    JointStateHandle,
    JointStateInterface,
    PositionJointInterface,
    PosVelAccJointHandle,
    PosVelAccJointInterface,
    PosVelJointHandle,
    PosVelJointInterface,
    RobotHW,
    VelocityJointInterface,
)

MAX_EFFORT = 10.0

_COMMANDS = {
    "position": (PositionJointInterface, JointHandle),
    "velocity": (VelocityJointInterface, JointHandle),
    "effort": (EffortJointInterface, JointHandle),
    "pos_vel": (PosVelJointInterface, PosVelJointHandle),
    "pos_vel_acc": (PosVelAccJointInterface, PosVelAccJointHandle),
}


@dataclass
class Faults:
    """What a test makes wrong with a joint.

    :param delay: cycles by which commands come late
    :param smoothing: share of what a position or velocity command asks for that is left undone each cycle, [0, 1)
    :param upper_bound: position that the joint cannot pass, rad or m
    :param wrap: report the position in (-pi, pi]
    :param nan: report NaN for position and velocity
    """

    delay: int = 0
    smoothing: float = 0.0
    upper_bound: float = math.inf
    wrap: bool = False
    nan: bool = False


class TestJoint:
    """One joint; ``position`` and ``velocity`` are the true state, ``state`` what is reported."""

    __test__ = False  # not a test case, whatever pytest thinks of the name

    def __init__(self, name: str, modes: list[str], position: float):
        self.state = JointStateHandle(name, position)
        self._initial = position
        self.handles: dict[str, Any] = {mode: _COMMANDS[mode][1](self.state) for mode in modes}
        self.mode = modes[0] if modes else ""
        self.position = position
        self.velocity = 0.0
        self.faults = Faults()
        self._late: deque = deque()
        for mode, handle in self.handles.items():
            if mode == "position":
                handle.command = position
            elif mode.startswith("pos_vel"):
                handle.command_position = position

    def reset(self) -> None:
        """Back to where it began, at rest."""
        self.position, self.velocity = self._initial, 0.0
        self._late.clear()

    def read(self) -> None:
        """True state to reported state."""
        position = math.remainder(self.position, 2.0 * math.pi) if self.faults.wrap else self.position
        self.state.position = math.nan if self.faults.nan else position
        self.state.velocity = math.nan if self.faults.nan else self.velocity
        self.state.effort = self.handles["effort"].command if self.mode == "effort" else 0.0

    def move(self, dt: float) -> None:
        """Obey the command for ``dt`` seconds."""
        if not self.mode:
            return
        handle = self.handles[self.mode]
        self._late.append(handle.command_position if self.mode.startswith("pos_vel") else handle.command)
        while len(self._late) > self.faults.delay + 1:
            self._late.popleft()
        command = self._late[0]
        before = self.position
        if self.mode == "velocity":
            self.position += command * dt * (1.0 - self.faults.smoothing)
        elif self.mode == "effort":
            self.velocity += max(-MAX_EFFORT, min(MAX_EFFORT, command)) * dt
            self.position += self.velocity * dt
        else:
            self.position = command + self.faults.smoothing * (self.position - command)
        self.position = min(self.position, self.faults.upper_bound)
        self.velocity = (self.position - before) / dt


class TestRobot(RobotHW):
    """Joints and sensors from the node's parameters, see the package docstring."""

    __test__ = False

    def __init__(self, parameters: dict):
        super().__init__()
        self.joints = {
            name: TestJoint(name, list(entry.get("interfaces", [])), float(entry.get("initial", 0.0)))
            for name, entry in parameters.get("joints", {}).items()
        }
        self.register_interface(JointStateInterface(*(joint.state for joint in self.joints.values())))
        for mode, (interface, _) in _COMMANDS.items():
            handles = [joint.handles[mode] for joint in self.joints.values() if mode in joint.handles]
            if handles:
                self.register_interface(interface(*handles))
        imus, force_torque_sensors = parameters.get("imus", {}), parameters.get("force_torque_sensors", {})
        self.register_interface(ImuSensorInterface(*(ImuSensorHandle(name, **fields) for name, fields in imus.items())))
        self.register_interface(
            ForceTorqueSensorInterface(*(ForceTorqueSensorHandle(name, **fields) for name, fields in force_torque_sensors.items()))
        )
        self.set_faults(parameters.get("faults", {}))

    def set_faults(self, faults: dict[str, dict]) -> None:
        """``faults`` by joint; joints not named have none."""
        for name, joint in self.joints.items():
            joint.faults = Faults(**faults.get(name, {}))

    def do_switch(self, start, stop) -> None:
        modes = {interface.type_name: mode for mode, (interface, _) in _COMMANDS.items()}
        for controller in start:
            for claimed in controller.claimed_resources:
                if claimed.hardware_interface in modes:
                    for name in claimed.resources:
                        self.joints[name].mode = modes[claimed.hardware_interface]

    def read(self, time: float, period: float) -> None:
        for joint in self.joints.values():
            joint.read()

    def write(self, time: float, period: float) -> None:
        for joint in self.joints.values():
            joint.move(period)
