"""What a window onto the world needs: a stream of poses while somebody looks, the description, the world as a file."""

from __future__ import annotations

import random
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import rospy
from ode_sim.description.exchange import dumps
from ode_sim.description.sdf_writer import world_text
from ode_sim_rendering.watch import SceneWatch
from ode_sim_viewer.contacts import ContactWatch
from ode_sim_viewer.saving import describe_now
from ode_sim_viewer.simulation import WorldRecord, record_world

from gazebo_ros.api.handlers import advertise
from gazebo_ros.api.on_demand import OnDemand
from gazebo_ros.msg import WorldContacts, WorldView
from gazebo_ros.server import Server, Stopped
from gazebo_ros.srv import DescribeWorld, SaveWorld

_PERIOD = 1.0 / 60.0  # wall s between two messages
_CONTACTS_PERIOD = 1.0 / 20.0
_WINDOW = 1.0  # wall s over which the real-time factor is taken


class RunClock:
    """Wall time that the simulation has run, and its real-time factor; asked and told in the physics thread."""

    def __init__(self, server: Server):
        self._server = server
        self._ran = 0.0
        self._since: float | None = None if server.paused else time.monotonic()
        self._sim_ns = server.world.time_ns
        self._marks: list = []
        server.stepped.connect(self._on_change)

    def read(self) -> tuple[float, float]:
        """(real time, s; real-time factor)."""
        now, sim_ns = time.monotonic(), self._server.world.time_ns
        if sim_ns < self._sim_ns:  # reset, or gone back on the timeline
            self._marks = []
            if sim_ns == 0:
                self._ran = 0.0
                self._since = None if self._server.paused else now
        self._sim_ns = sim_ns
        if self._since is None:
            return self._ran, 0.0
        self._marks = [mark for mark in self._marks if now - mark[0] <= _WINDOW] + [(now, sim_ns)]
        wall, sim = now - self._marks[0][0], (sim_ns - self._marks[0][1]) * 1e-9
        return self._ran + now - self._since, sim / wall if wall > 0.0 else 0.0

    def _on_change(self) -> None:
        now, paused = time.monotonic(), self._server.paused
        if paused and self._since is not None:
            self._ran, self._since, self._marks = self._ran + now - self._since, None, []
        elif not paused and self._since is None:
            self._since = now


class Stream:
    """A topic that is there, and published, while somebody subscribes; else there is no thread, and nothing is done in a step.

    :param on_demand: takes it on and off the graph
    :param read: the message, asked for in the physics thread
    :param watched: told there of the first subscriber, and of the last one's end
    :param name: of the topic. :param kind: class of its messages. :param period: wall s between two of them
    """

    def __init__(
        self,
        server: Server,
        on_demand: OnDemand,
        name: str,
        kind: type,
        period: float,
        read: Callable[[], Any],
        watched: Callable[[bool], None] = lambda on: None,
    ):
        self._server = server
        self._name, self._kind = name, kind
        self._period = period
        self._read = read
        self._watched = watched
        self._thread: threading.Thread | None = None
        self._lock = threading.Lock()
        self._publisher: rospy.Publisher | None = None
        on_demand.offer(name, self._make)

    def _make(self) -> rospy.Publisher:
        with self._lock:  # the first subscriber may be there before this ends
            self._publisher = rospy.Publisher(self._name, self._kind, subscriber_listener=_Listener(self._begin), queue_size=1)
            return self._publisher

    def _begin(self) -> None:
        with self._lock:
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, args=(self._publisher,), name="view", daemon=True)
                self._thread.start()

    def _run(self, publisher: rospy.Publisher) -> None:
        due = time.monotonic()
        try:
            self._server.call(lambda: self._watched(True))
            while True:
                with self._lock:
                    if not publisher.get_num_connections():
                        self._server.call(lambda: self._watched(False))
                        self._thread = None
                        return
                publisher.publish(self._server.call(self._read))
                due = max(due + self._period, time.monotonic())
                time.sleep(max(0.0, due - time.monotonic()))
        except (Stopped, rospy.ROSException):
            return


class ViewServices:
    """``~view`` (:class:`WorldView`), ``~view_contacts`` (:class:`WorldContacts`), ``~describe_world``,
    ``~save_world``."""

    def __init__(self, server: Server, on_demand: OnDemand):
        self._server, self._on_demand = server, on_demand
        self._watch = SceneWatch(server.world)
        self._clock = RunClock(server)
        self._revision = random.getrandbits(30)  # another one than that of the server before this one
        contacts = ContactWatch(server.world)
        self._streams: list[Stream] = [
            Stream(server, on_demand, "~view", WorldView, _PERIOD, self._read),
            Stream(
                server,
                on_demand,
                "~view_contacts",
                WorldContacts,
                _CONTACTS_PERIOD,
                lambda: WorldContacts(rospy.Time(0, server.world.time_ns), _bytes(contacts.read())),
                contacts.watch,
            ),
        ]
        advertise(server, "describe_world", DescribeWorld, self._describe, in_physics_thread=False)
        advertise(server, "save_world", SaveWorld, self._save, in_physics_thread=False)

    def _read(self) -> WorldView:
        self._look_for_news()
        world = self._server.world
        real_time, factor = self._clock.read()
        return WorldView(
            self._revision,
            rospy.Time(0, world.time_ns),
            real_time,
            world.iterations,
            self._server.paused,
            factor,
            _bytes(world.link_poses),
            _bytes(world.joint_positions),
        )

    def _look_for_news(self) -> None:
        if self._watch.changed():
            self._revision += 1

    def _describe(self, request, response) -> str:
        self._on_demand.now("~view")  # which whoever asks this is about to look at
        record = self._server.call(self._record)
        response.revision, response.world = record.revision, dumps(record)
        return "DescribeWorld: done"

    def _record(self) -> WorldRecord:
        self._look_for_news()
        return replace(record_world(self._server.world, self._revision), view=self._server.first_view)

    def _save(self, request, response) -> str:
        response.sdf = world_text(self._server.call(lambda: describe_now(self._server.world)))
        return "SaveWorld: done"


class _Listener(rospy.SubscribeListener):
    def __init__(self, begin):
        super().__init__()
        self._begin = begin

    def peer_subscribe(self, topic_name, topic_publish, peer_publish) -> None:
        self._begin()


def _bytes(array: np.ndarray) -> bytes:
    return np.ascontiguousarray(array, dtype="<f4").tobytes()
