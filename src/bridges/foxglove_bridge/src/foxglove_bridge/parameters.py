"""Parameters of the master, read and set by clients."""

from __future__ import annotations

import contextlib
import queue
import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Any

import rosgraph
import rospy
from foxglove.websocket import Parameter, StatusLevel
from rospy.core import get_node_uri
from rospy.impl.paramserver import get_param_server_cache

_CALM = 0.01  # s in which a wish that waits for Python's lock gets it, before changes are told
_AWAY = (rosgraph.MasterException, OSError)


class Parameters:
    """
    :param allowed: of a name
    :param changed: is told those that a client follows and that have another value now, or none

    A client's wish to follow comes while the library holds a lock that telling of changes wants, too, with Python's own lock in hand: who
    let Python's go in between, to ask the master, would have both wait for ever. So a thread does what takes time, and tells.
    """

    def __init__(
        self, allowed: Callable[[str], bool], changed: Callable[[list[Parameter]], None], complain: Callable[[str, StatusLevel], None]
    ) -> None:
        self._allowed, self._changed, self._complain = allowed, changed, complain
        self._lock = threading.Lock()  # of what has been told: for whoever reads or writes what may be told
        self._followed: dict[str, Any] = {}  # name -> value that was told last, None: it is not set
        self._jobs: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._look_is_due = threading.Event()
        threading.Thread(target=self._work, daemon=True).start()
        _hear_of_changes(self.look)

    def get(self, names: list[str]) -> list[Parameter]:
        """The parameters ``names``; all of them, where no name is given. What is not there or not allowed is told as an error."""
        wanted = names or sorted(filter(self._allowed, self._master.getParamNames()))
        values = {name: self._read(name) if self._allowed(name) else None for name in wanted}
        missing = [name for name in names if values[name] is None]
        if missing:
            self._complain(f"no such parameters, or ~param_whitelist hides them: {', '.join(missing)}", StatusLevel.Error)
        return [_made(name, value) for name, value in values.items() if value is not None]

    def set(self, parameters: list[Parameter]) -> list[Parameter]:
        """Set ``parameters``, as far as that is allowed. :return: what they are then; the server tells that to all who follow them"""
        values: dict[str, Any] = {}
        with self._lock:  # nobody looks in between, and tells it a second time
            for parameter in parameters:
                if not self._allowed(parameter.name):
                    self._complain(f"{parameter.name}: ~param_whitelist does not allow to set it", StatusLevel.Warning)
                elif parameter.value is not None:
                    self._master.setParam(parameter.name, parameter.get_value())
                    values[parameter.name] = self._read(parameter.name)
                elif self._read(parameter.name) is not None:
                    self._master.deleteParam(parameter.name)
            self._followed.update({name: value for name, value in values.items() if name in self._followed})
        self.look()  # for those that were deleted: the master does not tell a node what it has changed itself
        return [_made(name, value) for name, value in values.items() if value is not None]

    def follow(self, names: list[str]) -> None:
        """Tell of changes of ``names``."""
        self._jobs.put(partial(self._follow, names))

    def unfollow(self, names: list[str]) -> None:
        """Tell of changes of ``names`` no more."""
        self._jobs.put(partial(self._unfollow, names))

    def look(self) -> None:
        """Have what has changed told soon. The master says what changes, but not after it has been started anew."""
        if not self._look_is_due.is_set():
            self._look_is_due.set()
            self._jobs.put(self._look)

    def _work(self) -> None:
        while True:
            job = self._jobs.get()
            with contextlib.suppress(*_AWAY):  # it may come back, and what has changed is found later
                job()

    def _follow(self, names: list[str]) -> None:
        names = list(filter(self._allowed, names))
        with contextlib.suppress(*_AWAY):
            for name in names:
                self._master.subscribeParam(get_node_uri(), name)
        with self._lock:
            values = {name: self._read(name) for name in names}
            self._followed.update(values)
        self._tell({name: value for name, value in values.items() if value is not None})  # it may have changed since the client asked

    def _unfollow(self, names: list[str]) -> None:
        with self._lock:
            for name in names:
                self._followed.pop(name, None)
        for name in names:
            self._master.unsubscribeParam(get_node_uri(), name)

    def _look(self) -> None:
        self._look_is_due.clear()
        with self._lock:
            values = {name: self._read(name) for name in sorted(self._followed)}
            new = {name: value for name, value in values.items() if self._followed[name] != value}
            self._followed.update(new)
        self._tell(new)

    def _tell(self, values: dict[str, Any]) -> None:
        told = [_made(name, value) for name, value in values.items()]
        if told:
            time.sleep(_CALM)
            self._changed(told)

    @property
    def _master(self) -> rosgraph.Master:
        """A connection of its own: one cannot be shared by threads."""
        return rosgraph.Master(rospy.get_name())

    def _read(self, name: str) -> Any:
        """None: it is not set."""
        try:
            return self._master.getParam(name)
        except rosgraph.MasterError:
            return None


def _hear_of_changes(heard: Callable[[], None]) -> None:
    """Have ``heard`` called when the master tells this node of a parameter. rospy has a cache for those that it follows itself."""
    cache = get_param_server_cache()
    usual = cache.update

    def update(key: str, value: Any) -> None:
        heard()
        with contextlib.suppress(KeyError):  # not one of rospy's; to be told so, the master would take for the end of the following
            usual(key, value)

    cache.update = update


def _made(name: str, value: Any) -> Parameter:
    """Dates and whatever else the protocol has no word for go as text. One that is not set any more is an empty dictionary, which is what
    the master tells its followers, and upstream those of the bridge; the library leaves out what has no value."""
    try:
        return Parameter(name, value={} if value is None else value)
    except (TypeError, ValueError, OverflowError):
        return Parameter(name, value=str(value))
