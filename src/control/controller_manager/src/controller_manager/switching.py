"""What a switch request means for the controllers that are loaded, and its progress. No ROS graph in here."""

from __future__ import annotations

import threading
import time as wall
from collections.abc import Sequence

from hardware_interface import ControlError

from .loaded import LoadedController


class SwitchRefused(ControlError):
    """The switch cannot be done as asked; one line saying why."""


def plan(
    controllers: Sequence[LoadedController], start: Sequence[str], stop: Sequence[str], strict: bool
) -> tuple[list[LoadedController], list[LoadedController]]:
    """Which controllers really change: (to start, to stop), each in the order of the request.

    :param controllers: all that are loaded, in load order.
    :param strict: refuse what cannot be done, instead of leaving it out.
    :raises SwitchRefused: nothing may be changed.
    """
    by_name = {loaded.name: loaded for loaded in controllers}
    for names, verb in ((stop, "stop"), (start, "start")):
        for name in names:
            if strict and name not in by_name:
                raise SwitchRefused(
                    f"Could not {verb} controller with name '{name}' because no controller with this name "
                    f"exists; loaded: {', '.join(by_name) or 'none'}"
                )
    starting, stopping = dict.fromkeys(n for n in start if n in by_name), dict.fromkeys(n for n in stop if n in by_name)
    for name, loaded in by_name.items():
        if name in stopping and not loaded.running:
            if strict:
                raise SwitchRefused(f"Could not stop controller '{name}' since it is not running (it is {loaded.controller.state.value})")
            del stopping[name]
        if name in starting and loaded.running and name not in stopping:
            if strict:
                raise SwitchRefused(f"Could not start controller '{name}' since it is already running")
            del starting[name]
        if name in starting and name in stopping:
            raise SwitchRefused(f"Could not switch controllers: '{name}' is running and named in both lists; stop it first, then start it")
    return [by_name[name] for name in starting], [by_name[name] for name in stopping]


class Switch:
    """A switch on its way through the control loop.

    :param start, stop: controllers that begin and end. :param start_asap: each begins when its hardware is ready.
    :param timeout: s to wait for the hardware; 0 for ever.
    """

    def __init__(self, start: list[LoadedController], stop: list[LoadedController], start_asap: bool, timeout: float):
        self.start = start
        self.stop = stop
        self.start_info = [loaded.info for loaded in start]
        self.stop_info = [loaded.info for loaded in stop]
        self.start_asap = start_asap
        self.timeout = timeout
        self.begun = False
        self.cycles = 0  # of the loop, since the switch was handed to it
        self.hardware_failed = False
        self.failed: list[LoadedController] = []  # their starting() raised
        self.reported: list[str] = []  # names of those whose start the log says to be aborted
        self.finished = threading.Event()
        self._since = 0.0

    def begin(self, time: float) -> None:
        """The control loop takes it up, at ``time`` (s): ``timeout`` counts from here."""
        self.begun = True
        self._since = time

    def timed_out(self, time: float) -> bool:
        """On the loop's own clock, so that simulated and wall time are never mixed."""
        return self.timeout > 0.0 and time - self._since > self.timeout


#: s without a cycle of the loop, while the clock goes on, after which a switch is given up
PATIENCE = 10.0


class Patience:
    """How long a service waits for the control loop to do a switch.

    A loop that has run and makes no cycle although the clock goes on has died. While the clock stands still the simulation
    is paused; before its first cycle a robot may still be on its way up: both are waited for.
    """

    INTERVAL = 0.05  # s between two looks

    def __init__(self, switch: Switch):
        self._switch = switch
        now = wall.monotonic()
        self._deadline = now + switch.timeout + 1.0 if switch.timeout > 0.0 else None
        self._looked = now
        self._silent = 0.0  # s of wall time during which the clock went on without a cycle
        self._clock = 0.0
        self._cycles = 0

    def exhausted(self, clock: float, begun: bool) -> str | None:
        """To be called every INTERVAL. :return: why the wait is over, in words; None to wait on.

        :param clock: s, ROS time
        :param begun: whether the loop has ever made a cycle
        """
        now = wall.monotonic()
        if self._deadline is not None and now > self._deadline:
            return "the control loop did not finish the switch within the timeout"
        passed, self._looked = min(now - self._looked, 2.0 * self.INTERVAL), now
        if self._switch.cycles != self._cycles or not begun:
            self._cycles, self._silent = self._switch.cycles, 0.0
        elif clock != self._clock:
            self._silent += passed
        self._clock = clock
        if self._silent > PATIENCE:
            return (
                f"the control loop has made no cycle for {PATIENCE:g} s although the clock goes on; has the hardware's "
                f"node or plugin failed? Look for its error"
            )
        return None
