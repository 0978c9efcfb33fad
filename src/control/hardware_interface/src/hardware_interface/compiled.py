"""Robots in both languages.

``twin(robot)`` is the C++ robot that compiled controllers are given: for a robot written in Python one whose handles point at the
numbers of Python's handles, for a robot written in C++ that robot itself. ``CompiledRobotHW`` shows a robot written in C++ to
Python's controllers; its handles are views of the robot's own numbers. So controllers of both languages work side by side on
either.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from . import handles as _handles
from . import interfaces as _interfaces
from ._robots import Record, Robot
from .interfaces import HardwareInterface
from .robot_hw import ControllerInfo, RobotHW, SwitchState

#: C++ name of an interface -> (its class, that of its handles, that of their states or None for sensors)
_KNOWN: dict[str, tuple[type, type, type | None]] = {
    interface.type_name: (interface, getattr(_handles, handle), getattr(_handles, state) if state else None)
    for interface, handle, state in (
        (_interfaces.JointStateInterface, "JointStateHandle", None),
        (_interfaces.PositionJointInterface, "JointHandle", "JointStateHandle"),
        (_interfaces.VelocityJointInterface, "JointHandle", "JointStateHandle"),
        (_interfaces.EffortJointInterface, "JointHandle", "JointStateHandle"),
        (_interfaces.JointCommandInterface, "JointHandle", "JointStateHandle"),
        (_interfaces.PosVelJointInterface, "PosVelJointHandle", "JointStateHandle"),
        (_interfaces.PosVelAccJointInterface, "PosVelAccJointHandle", "JointStateHandle"),
        (_interfaces.PositionVelocityTorqueGainsJointInterface, "PositionVelocityTorqueGainsJointHandle", "JointStateHandle"),
        (_interfaces.JointModeInterface, "JointModeHandle", None),
        (_interfaces.ActuatorStateInterface, "ActuatorStateHandle", None),
        (_interfaces.PositionActuatorInterface, "ActuatorHandle", "ActuatorStateHandle"),
        (_interfaces.VelocityActuatorInterface, "ActuatorHandle", "ActuatorStateHandle"),
        (_interfaces.EffortActuatorInterface, "ActuatorHandle", "ActuatorStateHandle"),
        (_interfaces.ImuSensorInterface, "ImuSensorHandle", None),
        (_interfaces.ForceTorqueSensorInterface, "ForceTorqueSensorHandle", None),
    )
}


def _record(handle: Any) -> Record:
    state = getattr(handle, "state", None)
    if isinstance(handle, _handles.JointModeHandle):
        return Record(handle.name, "", (), (handle._address,))
    if isinstance(handle, _handles.JointStateHandle):
        return Record(handle.name, "", handle._addresses, ())
    return Record(handle.name, getattr(handle, "frame_id", ""), () if state is None else state._addresses, handle._addresses)


class _Twin:
    """What a robot written in Python keeps of its twin."""

    def __init__(self) -> None:
        self.robot = Robot()
        self.handles: dict[tuple[str, str], Any] = {}
        self.parts: list[RobotHW] = []


def twin(robot: RobotHW) -> Robot:
    """The C++ robot of ``robot``; what was registered since the last call is added to it."""
    if isinstance(robot, CompiledRobotHW):
        return robot.core
    if robot._twin is None:
        robot._twin = _Twin()
        part = robot.compiled_part()
        if part is not None:
            robot._twin.robot.add_manager(part, part)
    known = robot._twin
    for type_name, interface in robot._interfaces.items():
        if not Robot.knows(type_name):
            continue  # an interface of Python only
        new = [handle for handle in interface.handles() if known.handles.get((type_name, handle.name)) is not handle]
        if new or (type_name, "") not in known.handles:
            known.robot.fill(type_name, [_record(handle) for handle in new], (interface, new))
            known.handles.update({(type_name, handle.name): handle for handle in new})
            known.handles[type_name, ""] = interface
    for part in robot._children:
        core = twin(part)
        if part not in known.parts:
            known.robot.add_manager(core, core)
            known.parts.append(part)
    return known.robot


def _infos(controllers: Sequence[ControllerInfo]) -> list[tuple[str, str, list[tuple[str, list[str]]]]]:
    return [
        (info.name, info.type, [(claimed.hardware_interface, list(claimed.resources)) for claimed in info.claimed_resources])
        for info in controllers
    ]


class CompiledRobotHW(RobotHW):
    """A robot written in C++, as Python's controllers and the controller manager see it.

    :param core: the robot.
    """

    def __init__(self, core: Robot):
        super().__init__()
        self.core = core

    def get(self, interface: Any) -> Any:
        name = interface if isinstance(interface, str) else interface.type_name
        if name in self.core.names():
            self._show(name)
        return super().get(name)

    def interface_names(self) -> list[str]:
        return sorted(set(self.core.names()) | set(super().interface_names()))

    def _show(self, type_name: str) -> None:
        """Views of the handles that are not shown yet."""
        shown = self._interfaces.get(type_name)
        if type_name not in _KNOWN:
            if shown is None:  # of a third party: Python's controllers cannot use it, but can be told that it is there
                self.register_interface(type("_Unknown", (HardwareInterface,), {"type_name": type_name})())
            return
        interface_class, handle_class, state_class = _KNOWN[type_name]
        if shown is None:
            shown = interface_class()
            self.register_interface(shown)
        for record in self.core.handles(type_name):
            if record.name not in shown:
                shown.register_handle(self._view(record, handle_class, state_class))

    def _view(self, record: Record, handle_class: type, state_class: type | None) -> Any:
        if handle_class is _handles.JointModeHandle:
            handle = handle_class(record.name)
            handle._look_at(record.data[0], self.core)
        elif state_class is not None:
            state = state_class(record.name)
            state._look_at(tuple(record.state), self.core)
            handle = handle_class(state)
            handle._look_at(tuple(record.data), self.core)
        else:
            handle = handle_class(record.name, record.frame_id) if not record.state else handle_class(record.name)
            handle._look_at(tuple(record.state or record.data), self.core)
        return handle

    def read(self, time: float, period: float) -> None:
        self.core.read(time, period)

    def write(self, time: float, period: float) -> None:
        self.core.write(time, period)

    def check_for_conflict(self, controllers: Sequence[ControllerInfo]) -> bool:
        return self.core.check_for_conflict(_infos(controllers))

    def prepare_switch(self, start: Sequence[ControllerInfo], stop: Sequence[ControllerInfo]) -> bool:
        return self.core.prepare_switch(_infos(start), _infos(stop))

    def do_switch(self, start: Sequence[ControllerInfo], stop: Sequence[ControllerInfo]) -> None:
        self.core.do_switch(_infos(start), _infos(stop))

    def switch_result(self, controller: ControllerInfo | None = None) -> SwitchState:
        return SwitchState(self.core.switch_result(None if controller is None else _infos([controller])[0]))
