"""Moving states and commands through transmissions, once per cycle."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from .transmissions import Transmission

Convert = Callable[[Sequence[float]], Sequence[float]]

#: attribute of a state handle -> the kind of quantity that it is to a transmission
_STATE = {"position": "position", "velocity": "velocity", "effort": "effort"}
_SENSORS = {"absolute_position": "absolute", "torque_sensor": "effort"}


class TransmissionPipeline:
    """Values of one kind in one direction, through all registered transmissions.

    :param target: "joint" or "actuator", where the values go.
    :param fields: attributes of the handles that are moved -> position, velocity, effort or absolute.
    """

    def __init__(self, target: str, fields: dict[str, str]):
        self._target = target
        self._fields = fields
        self._entries: dict[str, list[tuple[str, Convert, list[Any], list[Any]]]] = {}

    @classmethod
    def of_states(cls, target: str) -> TransmissionPipeline:
        """Everything that is measured, to ``target``: "joint" or "actuator"; to joints also absolute encoders and torque sensors where all
        have them.
        """
        return cls(target, {**_STATE, **_SENSORS} if target == "joint" else _STATE)

    @classmethod
    def of_commands(cls, target: str, kind: str) -> TransmissionPipeline:
        """Commands of one ``kind`` (position, velocity or effort) to ``target``: "actuator" or "joint"."""
        return cls(target, {"command": kind})

    def register(self, name: str, transmission: Transmission, actuators: Sequence[Any], joints: Sequence[Any]) -> None:
        """:param name: of the transmission.
        :param actuators, joints: handles in the transmission's order (state handles for states, else command handles).
        """
        sources, targets = (actuators, joints) if self._target == "joint" else (joints, actuators)
        self._entries[name] = [
            (field, getattr(transmission, f"{kind}_to_{self._target}"), list(sources), list(targets))
            for field, kind in self._fields.items()
        ]

    def names(self) -> list[str]:
        """Of the transmissions, in the order of their registration."""
        return list(self._entries)

    def propagate(self) -> None:
        """Bring the present values from one side to the other. Realtime safe."""
        for entry in self._entries.values():
            for field, convert, sources, targets in entry:
                values = [getattr(handle, field) for handle in sources]
                if None not in values:
                    for handle, value in zip(targets, convert(values)):
                        setattr(handle, field, value)
