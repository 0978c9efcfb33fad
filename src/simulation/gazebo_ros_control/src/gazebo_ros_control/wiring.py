"""The joints of a robot, read in one call and commanded in another: ``core/wiring.hpp`` says how a command gets to its joint."""

from __future__ import annotations

from collections.abc import Iterable

from hardware_interface import addresses

from . import _wiring
from .joint_sim import JointSim, Mode


class Wiring:
    """:param sims: the joints, with all their modes. Handles of the joints keep their places as long as this lives."""

    def __init__(self, sims: Iterable[JointSim]) -> None:
        self._sims = tuple(sims)
        self._core = _wiring.Wiring()
        self._modes: list[Mode] = []  # by number in the core
        self._numbers: dict[Mode, int] = {}
        self._by_pid: tuple[JointSim, ...] = ()  # whose mode writes for itself
        self.read = self._core.read  #: positions, velocities and what drives bear, into the states
        self.stop = self._core.stop  #: emergency stop: begins or ends
        self._write = self._core.write
        self._joints = [self._core.add_joint(sim.joint.core.address, *addresses(sim.state)[:3]) for sim in self._sims]
        for joint, sim in zip(self._joints, self._sims):
            for mode in sim.modes.values():
                if mode.bears:
                    sim.joint.core.watch()
                if mode.wired:
                    self._add(joint, mode)
        self.engage()

    def _add(self, joint: int, mode: Mode) -> None:
        command, slope = addresses(mode.handle)[:2]
        self._numbers[mode] = self._core.add_command(joint, command, slope, mode.limits.law, mode.effort_limit)
        self._modes.append(mode)

    def engage(self) -> None:
        """Other modes may be in force."""
        for joint, sim in zip(self._joints, self._sims):
            self._core.report_load(joint, sim.mode.bears)
            self._core.engage(joint, self._numbers.get(sim.mode, -1))
        self._by_pid = tuple(sim for sim in self._sims if sim.mode not in self._numbers)

    def write(self, dt: float) -> None:
        """Commands to the joints. :param dt: s since the last time."""
        refused = self._write(dt)
        if refused:
            for number, wanted in refused:
                self._modes[number].limits.warn(wanted)
        for sim in self._by_pid:
            sim.mode.write(dt)
