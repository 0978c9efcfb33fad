"""The simulated world in the examiner's hands: time passes when it says so, and everything is read to the last digit."""

from __future__ import annotations

import time
import xmlrpc.client
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any
from xml.parsers.expat import ExpatError

import rosgraph

from ..errors import LabError
from ..isolation.supervise import Program
from . import connections
from .lockstep import Nodes
from .simulator import Lost, Refused, Wire, checked_state, png_of

CONNECTED = 0.12  # s of rest after something new: connections are made by threads that look every hundredth of a second
_UNCONNECTED = 0.3  # s of rest after which a connection that is missing is looked for again
_LOOKS = 4  # at missing connections: who is asked for by a node that has ended never comes
_LEAVING = 3.0  # s of wall time that a program gets for its end
_ROUNDS = 20  # of news from the master that one moment can have


class Gone(LabError, RuntimeError):
    """The simulator, the launch or a limit ended the session; a sentence for the student."""


@dataclass
class Sample:
    """``time`` s of simulation; the rest as :class:`lab_check.examination.probe.Probe` writes it."""

    time: float
    models: dict[str, Any]
    contacts: list[list[str]]

    def joint(self, name: str, model: str = "") -> list[float] | None:
        """[position, velocity, effort] of the first movable model's joint of that name."""
        for key, entry in self.models.items():
            if (not model or key == model) and name in entry.get("joints", {}):
                return entry["joints"][name]
        return None

    def models_with(self, joint: str) -> list[str]:
        """Names of the models that have ``joint``."""
        return [name for name, entry in self.models.items() if joint in entry.get("joints", {})]

    def place(self, name: str) -> list[float] | None:
        """Pose of ``name``, ``model`` or ``model::link``: x, y, z, qx, qy, qz, qw; None where it is not there."""
        model, _, link = name.partition("::")
        entry = self.models.get(model)
        if entry is None:
            return None
        return entry.get("links", {}).get(link) if link else entry["pose"]

    def identity(self, name: str) -> int | None:
        """Which model of its name ``name`` belongs to, ``model`` or ``model::link``: another number after it was replaced. None where
        it is not there."""
        return None if self.place(name) is None else self.models[name.partition("::")[0]]["serial"]

    def owner(self, joint: str, model: str = "") -> tuple[str, int] | None:
        """Name and :meth:`identity` of the model whose joint :meth:`joint` tells."""
        for key, entry in self.models.items():
            if (not model or key == model) and joint in entry.get("joints", {}):
                return key, entry["serial"]
        return None


class Bench:
    """
    :param wire: to the simulator
    :param alive: raises :class:`Gone` when the session has ended
    :param quantum: s of simulated time between two samples
    """

    def __init__(self, nodes: Nodes, wire: Wire, quantum: float, alive: Callable[[], None]):
        self.nodes, self.alive = nodes, alive
        self._wire = wire
        self._master = rosgraph.Master("/lab_check")
        self.on_sample: list[Callable[[Sample], None]] = []
        self.now = self._read()
        self.dt = self._dt
        self.count = max(1, round(quantum / self.dt))
        self.quantum = self.count * self.dt
        self.unsettled = 0
        self.simulator = ""  # URI of its node

    def _read(self) -> Sample:
        data = self._state()
        self._dt = data["dt"]
        return Sample(data["time_ns"] / 1e9, data["models"], data["contacts"])

    def _state(self) -> dict[str, Any]:
        try:
            return checked_state(self._ask("state"))
        except Lost as error:
            raise Gone(str(error)) from error

    def _ask(self, what: str, *arguments: Any) -> Any:
        try:
            return self._wire.ask(what, *arguments)
        except (Lost, Refused) as error:
            self.alive()
            raise Gone(str(error)) from error

    def settle(self, rest: float = CONNECTED, patience: float = 10.0) -> None:
        """Everybody has done what there was to do; new processes included, and those who now hear of new publishers.

        :param rest, patience: as for ``Nodes.settle``
        """
        for _ in range(_ROUNDS):
            self.nodes.find()
            if not self.nodes.settle(rest, patience):
                self.unsettled += 1
            self.alive()
            if not self._news():
                return
            rest = max(rest, CONNECTED)

    def _news(self) -> int:
        try:
            return connections.release(self._master)
        except (OSError, xmlrpc.client.Error, ExpatError, ValueError) as error:
            self.alive()
            raise Gone(f"the ROS master does not answer any more ({error})") from error

    def connect(self) -> None:
        """As :meth:`settle`, and every subscriber is connected to every publisher."""
        self.settle(0.05)
        deaf: set[str] = set()
        for _ in range(_LOOKS):
            if connections.complete(self._master, deaf):
                break
            self.settle(_UNCONNECTED)
        self.settle(CONNECTED)

    def tick(self) -> Sample:
        """One quantum: the world moves while the nodes stand still, then they answer."""
        self.nodes.find()
        self.nodes.stop()
        try:
            self._ask("step", self.count)
        finally:
            self.nodes.go_on()
        if not self.nodes.settle():
            self.unsettled += 1
        self.alive()
        if self._news():
            self.settle()
        return self.look()

    def look(self) -> Sample:
        """What the world is like now, shown to all who watch."""
        self.now = self._read()
        for f in self.on_sample:
            f(self.now)
        return self.now

    def pass_time(self, seconds: float) -> None:
        """Let ``seconds`` of simulated time pass, quantum by quantum."""
        end = self.now.time + seconds - 1e-9
        while self.now.time < end:
            self.tick()

    def until(self, done: Callable[[], bool], seconds: float) -> bool:
        """Lets time pass until ``done()``; False after that many simulated seconds."""
        end = self.now.time + seconds
        while not done():
            if self.now.time >= end:
                return False
            self.tick()
        return True

    def leave(self, program: Program) -> None:
        """A program that has done its work takes wall time to end: simulated time stands still for it."""
        end = time.monotonic() + _LEAVING
        while program.running and time.monotonic() < end:
            time.sleep(0.02)
        if program.running:  # on a busy machine it may be at its end yet
            self.nodes.settle(_UNCONNECTED)

    def watch_contacts(self, of: str | bool) -> None:
        """Have contacts of the model ``of`` (or ``model::link``; True: of all) told in each sample from now on; False: none any more."""
        self._ask("contacts", of)

    def seen(self, topic: str) -> dict[str, float] | str:
        """``model::link::visual`` -> its share of the picture that the camera of this topic would take now; or a sentence."""
        try:
            found = self._wire.ask("seen", topic)
            return {str(name): float(share) for name, share in found.items()}
        except Refused as error:
            return str(error).partition(": ")[2] or str(error)
        except (Lost, AttributeError, TypeError, ValueError) as error:
            self.alive()
            raise Gone(str(error)) from error

    def picture(self, model: str = "", width: int = 640, height: int = 400) -> bytes:
        """A PNG of ``model`` ("": of the world), ``width`` x ``height`` pixels; b'' where the simulator cannot draw."""
        try:
            return png_of(self._wire.ask("picture", model if model in self.now.models else "", width, height))
        except (Refused, Lost, Gone):
            return b""

    def changes(self) -> list[tuple[str, str, int, float]]:
        """Who changed the world by the simulator's services or topics: (which, node, how often, s of simulation of the first time)."""
        try:
            return [(str(what), str(who), int(count), float(first)) for what, who, count, first in self._ask("changed")]
        except (TypeError, ValueError) as error:
            raise Gone(f"the simulator does not answer any more: {error}") from error
