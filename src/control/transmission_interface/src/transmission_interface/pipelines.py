"""Moving states and commands through transmissions, once per cycle."""
from __future__ import annotations

from typing import Any, Dict, List, Sequence

from .transmissions import Transmission


class TransmissionPipeline:
    """Values of one kind in one direction, through all registered transmissions."""

    def __init__(self, propagate: Any):
        self._propagate = propagate
        self._entries: Dict[str, tuple] = {}

    def register(self, name: str, transmission: Transmission, actuators: Sequence[Any], joints: Sequence[Any]) -> None:
        """:param name: of the transmission.
        :param actuators, joints: handles in the transmission's order (state handles for states, else command handles).
        """
        self._entries[name] = (transmission, list(actuators), list(joints))

    def names(self) -> List[str]:
        return list(self._entries)

    def propagate(self) -> None:
        for entry in self._entries.values():
            self._propagate(*entry)


def _all_have(handles: Sequence[Any], field: str) -> bool:
    return all(getattr(handle, field) is not None for handle in handles)


def _copy(values: Sequence[float], handles: Sequence[Any], field: str) -> None:
    for handle, value in zip(handles, values):
        setattr(handle, field, value)


def actuator_to_joint_state(transmission: Transmission, actuators: Sequence[Any], joints: Sequence[Any]) -> None:
    _copy(transmission.position_to_joint([a.position for a in actuators]), joints, "position")
    _copy(transmission.velocity_to_joint([a.velocity for a in actuators]), joints, "velocity")
    _copy(transmission.effort_to_joint([a.effort for a in actuators]), joints, "effort")
    if _all_have(actuators, "absolute_position"):
        absolute = [a.absolute_position for a in actuators]
        _copy(absolute[::-1] if transmission.direct_absolute_encoders else transmission.position_to_joint(absolute),
              joints, "absolute_position")
    if _all_have(actuators, "torque_sensor"):
        _copy(transmission.effort_to_joint([a.torque_sensor for a in actuators]), joints, "torque_sensor")


def joint_to_actuator_state(transmission: Transmission, actuators: Sequence[Any], joints: Sequence[Any]) -> None:
    _copy(transmission.position_to_actuator([j.position for j in joints]), actuators, "position")
    _copy(transmission.velocity_to_actuator([j.velocity for j in joints]), actuators, "velocity")
    _copy(transmission.effort_to_actuator([j.effort for j in joints]), actuators, "effort")
    if _all_have(joints, "absolute_position"):
        absolute = [j.absolute_position for j in joints]
        _copy(absolute[::-1] if transmission.direct_absolute_encoders else transmission.position_to_actuator(absolute),
              actuators, "absolute_position")
    if _all_have(joints, "torque_sensor"):
        _copy(transmission.effort_to_actuator([j.torque_sensor for j in joints]), actuators, "torque_sensor")


def joint_to_actuator_command(kind: str) -> Any:
    """:param kind: position, velocity or effort."""
    def propagate(transmission: Transmission, actuators: Sequence[Any], joints: Sequence[Any]) -> None:
        _copy(getattr(transmission, f"{kind}_to_actuator")([j.command for j in joints]), actuators, "command")
    return propagate


def actuator_to_joint_command(kind: str) -> Any:
    """:param kind: position, velocity or effort."""
    def propagate(transmission: Transmission, actuators: Sequence[Any], joints: Sequence[Any]) -> None:
        _copy(getattr(transmission, f"{kind}_to_joint")([a.command for a in actuators]), joints, "command")
    return propagate
