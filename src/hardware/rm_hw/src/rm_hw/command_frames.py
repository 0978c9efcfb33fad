"""Which frames a set of actuators needs each cycle, and the frames that switch them off."""

from __future__ import annotations

from collections.abc import Iterable

from rm_hw.actuator import Actuator
from rm_hw.frames import command_slot, pack_cheetah_command, pack_command

_HALTED_PERIOD = 0.1  # s between frames to motors that do not answer

Frame = tuple[int, bytes]


class CommandFrames:
    """Command frames for the actuators of one bus.

    A RoboMaster frame carries four motors, so motors are grouped by frame. A group of which no motor answers gets its
    zero frame ten times a second only: on a bus where nobody acknowledges, a thousand frames a second fill the
    interface's queue. It does get it: a motor whose *feedback* cable is broken still obeys its last command.
    """

    def __init__(self, actuators: Iterable[Actuator]) -> None:
        self._groups: dict[int, list[Actuator | None]] = {}
        self._cheetahs: list[Actuator] = []
        for actuator in actuators:
            if "cheetah" in actuator.type:
                self._cheetahs.append(actuator)
            else:
                command_id, slot = command_slot(actuator.id)
                self._groups.setdefault(command_id, [None] * 4)[slot] = actuator
        self._due: dict[int, float] = {}

    def build(self, now: float) -> list[Frame]:
        """Frames to send at monotonic time ``now`` (s), for the actuators' ``executed_effort``."""
        frames = []
        for command_id, group in self._groups.items():
            if self._wanted(command_id, any(a is not None and not a.halted for a in group), now):
                frames.append((command_id, pack_command([0 if a is None else a.command_counts(a.executed_effort) for a in group])))
        for actuator in self._cheetahs:
            if self._wanted(actuator.id, not actuator.halted, now):
                frames.append(self._cheetah(actuator, 0.0 if actuator.halted else actuator.executed_effort))
        return frames

    def zero(self) -> list[Frame]:
        """Frames that take the current from all motors."""
        return [(command_id, bytes(8)) for command_id in self._groups] + [self._cheetah(a, 0.0) for a in self._cheetahs]

    def _wanted(self, key: int, alive: bool, now: float) -> bool:
        if not alive and now < self._due.get(key, 0.0):
            return False
        self._due[key] = now + _HALTED_PERIOD
        return True

    @staticmethod
    def _cheetah(actuator: Actuator, effort: float) -> Frame:
        k = actuator.coefficients
        if effort - effort != 0.0:
            effort = 0.0  # not a finite number
        return actuator.id, pack_cheetah_command(
            k.pos2act * -k.act2pos_offset, k.vel2act * -k.act2vel_offset, 0.0, 0.0, round(k.effort2act * (effort - k.act2effort_offset))
        )
