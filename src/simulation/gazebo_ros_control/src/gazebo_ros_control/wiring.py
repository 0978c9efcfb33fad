"""The joints of a robot, all of them read in one call and commanded in another: the rules of joint_sim.py in the core."""
from __future__ import annotations

from typing import Dict, Iterable, List, Tuple

from hardware_interface import addresses
from ode_sim import _core

from .joint_sim import JointSim, Mode


class Wiring:
    """:param sims: the joints, with all their modes. Handles of the joints keep their places as long as this lives."""

    def __init__(self, sims: Iterable[JointSim]) -> None:
        self._sims = tuple(sims)
        self._core = _core.Wiring()
        self._modes: List[Mode] = []  # by number in the core
        self._numbers: Dict[Mode, int] = {}
        self._by_hand: Tuple[JointSim, ...] = ()  # whose mode writes for itself
        self._stopped = False
        self.read = self._core.read  #: positions, velocities and what drives bear, into the states
        self._write = self._core.write
        self._joints = [self._core.add_joint(sim.joint.core, *addresses(sim.state)[:3]) for sim in self._sims]
        for joint, sim in zip(self._joints, self._sims):
            for mode in sim.modes.values():
                if mode.bears:
                    sim.joint.core.watch()
                if mode.wired:
                    self._add(joint, mode)
        self.reset()
        self.engage()

    def _add(self, joint: int, mode: Mode) -> None:
        command, slope = addresses(mode.handle)[:2]
        limits = mode.limits
        self._numbers[mode] = self._core.add_command(joint, command, slope, mode.effort_limit, limits.rule,
                                                     limits.limits.has_position_limits, limits.numbers())
        self._modes.append(mode)

    def engage(self) -> None:
        """Other modes may be in force; those that were not before have just entered."""
        for wired in self._numbers.values():
            self._core.set_working(wired, False)
        by_hand = []
        for joint, sim in zip(self._joints, self._sims):
            self._core.report_load(joint, sim.mode.bears)
            number = self._numbers.get(sim.mode)
            if number is None or self._stopped:
                by_hand.append(sim)
            else:
                self._core.set_working(number, True)
        self._by_hand = tuple(by_hand)

    def enter(self, mode: Mode) -> None:
        """Start from where the limits of the mode were just reset to."""
        if mode in self._numbers:
            self._core.set_previous(self._numbers[mode], mode.limits.previous)

    def reset(self) -> None:
        """The limits of all modes were reset."""
        for mode in self._numbers:
            self.enter(mode)

    def stop(self, active: bool) -> None:
        """While an emergency stop lasts every mode writes for itself."""
        if active is self._stopped:
            return
        self._stopped = active
        for mode, number in self._numbers.items():
            if active:
                mode.limits.previous = self._core.previous(number)
            else:
                self.enter(mode)
        self.engage()

    def write(self, dt: float) -> None:
        """Commands to the joints. :param dt: s since the last time."""
        refused = self._write(dt)
        if refused:
            for number, wanted, held in refused:
                self._modes[number].limits.instead(wanted, held)
        for sim in self._by_hand:
            sim.mode.write(dt)
