"""The simulated world in the examiner's hands: time passes when it says so, and everything is read to the last digit."""
from __future__ import annotations

import json
import time
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Optional, Set

import rosgraph
import rospy
from gazebo_ros.srv import StepWorld, TakePicture
from std_srvs.srv import SetBool, Trigger

from . import connections
from .errors import LabError
from .lockstep import Nodes
from .supervise import Program

CONNECTED = 0.12  # s of rest after something new: connections are made by threads that look every hundredth of a second
_UNCONNECTED = 0.3  # s of rest after which a connection that is missing is looked for again
_LOOKS = 4  # at missing connections: who is asked for by a node that has ended never comes
_LEAVING = 3.0  # s of wall time that a program gets for its end
_ROUNDS = 20  # of news from the master that one moment can have


class Gone(LabError, RuntimeError):
    """The simulator, the launch or a limit ended the session; a sentence for the student."""


@dataclass
class Sample:
    """``time`` s of simulation; the rest as :class:`lab_check.probe.Probe` writes it."""

    time: float
    models: Dict[str, Any]
    contacts: List[List[str]]

    def joint(self, name: str, model: str = "") -> Optional[List[float]]:
        """[position, velocity, effort] of the first movable model's joint of that name."""
        for key, entry in self.models.items():
            if (not model or key == model) and name in entry.get("joints", {}):
                return entry["joints"][name]
        return None

    def place(self, name: str) -> Optional[List[float]]:
        """Pose of ``model`` or ``model::link``: x, y, z, qx, qy, qz, qw."""
        model, _, link = name.partition("::")
        entry = self.models.get(model)
        if entry is None:
            return None
        return entry.get("links", {}).get(link) if link else entry["pose"]


class Bench:
    """
    :param alive: raises :class:`Gone` when the session has ended
    :param quantum: s of simulated time between two samples
    """

    def __init__(self, nodes: Nodes, quantum: float, alive: Callable[[], None]):
        self.nodes, self.alive = nodes, alive
        self._master = rosgraph.Master("/lab_check")
        self.on_sample: List[Callable[[Sample], None]] = []
        self._step = rospy.ServiceProxy("/gazebo/step", StepWorld, persistent=True)
        self._state = rospy.ServiceProxy("/gazebo/lab_check_state", Trigger, persistent=True)
        self._contacts = rospy.ServiceProxy("/gazebo/lab_check_contacts", SetBool)
        self._picture = rospy.ServiceProxy("/gazebo/take_picture", TakePicture)
        self._seen = rospy.ServiceProxy("/gazebo/lab_check_seen", TakePicture)
        self.now = self._read()
        self.dt = self._dt
        self.count = max(1, round(quantum / self.dt))
        self.quantum = self.count * self.dt
        self.unsettled = 0

    def _read(self) -> Sample:
        data = json.loads(self._ask(self._state).message)
        self._dt = data["dt"]
        return Sample(data["time_ns"] / 1e9, data["models"], data["contacts"])

    def _ask(self, service, *arguments):
        try:
            return service(*arguments)
        except (rospy.ServiceException, rospy.ROSException, OSError, ValueError) as error:
            self.alive()
            raise Gone(f"the simulator does not answer any more ({error})") from error

    def settle(self, rest: float = CONNECTED, patience: float = 10.0) -> None:
        """Everybody has done what there was to do; new processes included, and those who now hear of new publishers."""
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
        except OSError as error:
            self.alive()
            raise Gone(f"the ROS master does not answer any more ({error})") from error

    def connect(self) -> None:
        """As :meth:`settle`, and every subscriber is connected to every publisher."""
        self.settle(0.05)
        deaf: Set[str] = set()
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
            answer = self._ask(self._step, self.count)
        finally:
            self.nodes.go_on()
        if not answer.success:
            self._ask(rospy.ServiceProxy("/gazebo/pause_physics", _empty()))
        if not self.nodes.settle():
            self.unsettled += 1
        self.alive()
        if self._news():
            self.settle()
        self.now = self._read()
        for f in self.on_sample:
            f(self.now)
        return self.now

    def pass_time(self, seconds: float) -> None:
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

    def watch_contacts(self, on: bool) -> None:
        self._ask(self._contacts, on)

    def seen(self, topic: str) -> "Dict[str, float] | str":
        """``model::link::visual`` -> its share of the picture that the camera of this topic would take now; or a sentence."""
        answer = self._ask(self._seen, "", topic, 0, 0)
        return json.loads(answer.status_message) if answer.success else answer.status_message

    def picture(self, model: str = "", width: int = 640, height: int = 400) -> bytes:
        """A PNG, b'' where the simulator cannot draw."""
        try:
            answer = self._picture(model if model in self.now.models else "", "iso", width, height)
        except rospy.ServiceException:
            return b""
        return bytes(answer.png) if answer.success else b""


def _empty():
    from std_srvs.srv import Empty
    return Empty


def wait_for_simulator(alive: Callable[[], None], left: Callable[[], float], optional: Callable[[], bool]) -> bool:
    """True when it answers, False when it does not come and need not (``optional()``)."""
    import rosgraph
    master = rosgraph.Master("/lab_check")
    while left():
        alive()
        try:
            master.lookupService("/gazebo/lab_check_state")
            return True
        except (rosgraph.MasterException, OSError):
            if optional():
                return False
        time.sleep(0.05)
    return False
