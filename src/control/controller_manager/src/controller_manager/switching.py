"""What a switch request means for the controllers that are loaded, and its progress. No ROS in here."""
from __future__ import annotations

import threading
from typing import TYPE_CHECKING, List, Sequence, Tuple

if TYPE_CHECKING:
    from .manager import LoadedController


class Refused(Exception):
    """The switch cannot be done as asked; one line saying why."""


def plan(controllers: Sequence["LoadedController"], start: Sequence[str], stop: Sequence[str],
         strict: bool) -> Tuple[List["LoadedController"], List["LoadedController"]]:
    """Which controllers really change: (to start, to stop), each in the order of the request.

    :param controllers: all that are loaded, in load order.
    :param strict: refuse what cannot be done, instead of leaving it out.
    :raises Refused: nothing may be changed.
    """
    by_name = {loaded.name: loaded for loaded in controllers}
    for names, verb in ((stop, "stop"), (start, "start")):
        for name in names:
            if strict and name not in by_name:
                raise Refused(f"Could not {verb} controller with name '{name}' because no controller with this name "
                              f"exists; loaded: {', '.join(by_name) or 'none'}")
    starting, stopping = dict.fromkeys(n for n in start if n in by_name), dict.fromkeys(n for n in stop if n in by_name)
    for name, loaded in by_name.items():
        if name in stopping and not loaded.running:
            if strict:
                raise Refused(f"Could not stop controller '{name}' since it is not running "
                              f"(it is {loaded.controller.state.value})")
            del stopping[name]
        if name in starting and loaded.running and name not in stopping:
            if strict:
                raise Refused(f"Could not start controller '{name}' since it is already running")
            del starting[name]
        if name in starting and name in stopping:
            raise Refused(f"Could not switch controllers: '{name}' is running and named in both lists; stop it first, "
                          f"then start it")
    return [by_name[name] for name in starting], [by_name[name] for name in stopping]


class Switch:
    """A switch on its way through the control loop."""

    def __init__(self, start: List["LoadedController"], stop: List["LoadedController"], start_asap: bool,
                 timeout: float):
        self.start = start
        self.stop = stop
        self.start_info = [loaded.info for loaded in start]
        self.stop_info = [loaded.info for loaded in stop]
        self.start_asap = start_asap
        self.timeout = timeout
        self.begun = False
        self.hardware_failed = False
        self.failed: List["LoadedController"] = []  # their starting() raised
        self.reported: List[str] = []  # names of those whose start the log says to be aborted
        self.finished = threading.Event()
        self._since = 0.0

    def begin(self, time: float) -> None:
        self.begun = True
        self._since = time

    def timed_out(self, time: float) -> bool:
        """On the loop's own clock, so that simulated and wall time are never mixed."""
        return self.timeout > 0.0 and time - self._since > self.timeout
