"""The part that all sensors share: where the sensor is, and when it measures.

A sensor plugin says what it measures and whether anybody wants it::

    class Range(SensorPlugin):
        def load(self, server, sensor, sdf):
            self.publisher = rospy.Publisher(...)
            sensor.connect(self.measure, wanted=lambda: self.publisher.get_num_connections() > 0)

        def measure(self, sensor):      # physics thread, after a step; sensor.measurement_time is the stamp
            ...

An unwanted sensor costs one comparison a step, and nothing at all is measured.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import rospy
from node_signals.rates import LatenessKept
from ode_sim.handles import JointHandle

_NS = 1_000_000_000


def _always() -> bool:
    return True


class Count(NamedTuple):
    """How many measurements there were, and when the newest was: ns of sim time and of the system's monotonic clock."""

    number: int = 0
    sim_ns: int = 0
    wall_ns: int = 0


@dataclass
class _Consumer:
    measure: Callable[[Sensor], None]
    wanted: Callable[[], bool]
    owner: Any


class Sensor:
    """A sensor on a link, or of a joint, of a simulated model.

    ``description``
        ``ode_sim.description.model.Sensor``: name, type, pose X_LS, element (``<sensor>``), update_rate ...
    ``link``, ``model``
        the handles it is mounted on; of a joint's sensor the joint's child
    ``joint``
        the handle of the joint whose sensor it is, or None
    ``measurement_time``, ``measurement_ns``
        sim time of the newest update (``rospy.Time``, int nanoseconds)
    """

    def __init__(self, description, part, report: Callable[[Any, Exception], None]):
        self.description = description
        self.joint = part if isinstance(part, JointHandle) else None
        self.link = part if self.joint is None else part.child
        self.model = part.model
        self._of = part.scoped_name
        self.update_rate = LatenessKept(description.update_rate)
        self.measurement_ns = 0
        self.updates = Count()
        self._pictures: Count | None = None
        self.owner: Any = None  # the plugin being loaded: what it connects is its own
        self._report = report
        self._consumers: list[_Consumer] = []

    @property
    def name(self) -> str:
        return self.description.name

    @property
    def scoped_name(self) -> str:
        """``model::link::sensor`` or ``model::joint::sensor``"""
        return f"{self._of}::{self.description.name}"

    @property
    def type(self) -> str:
        return self.description.type

    @property
    def counted(self) -> Count:
        """What has come of it: measurements; of a camera, the pictures that were published."""
        return self.updates if self._pictures is None else self._pictures

    def pictured(self, measured_ns: int) -> None:
        """A picture of the update at ``measured_ns`` has been published; those of one update count once. Any thread."""
        before = self._pictures or Count()
        if measured_ns != before.sim_ns or not before.number:
            self._pictures = Count(before.number + 1, measured_ns, time.monotonic_ns())

    @property
    def measurement_time(self) -> rospy.Time:
        return rospy.Time(*divmod(self.measurement_ns, _NS))

    def connect(self, measure: Callable[[Sensor], None], wanted: Callable[[], bool] = _always) -> None:
        """Call ``measure(sensor)`` in the physics thread at every update while ``wanted()`` is true.

        ``wanted`` is only asked when an update is due. It usually tells whether a topic has subscribers.
        """
        self._consumers = self._consumers + [_Consumer(measure, wanted, self.owner)]

    def disconnect_owner(self, owner: Any) -> None:
        """Let ``owner``, a plugin, be told of nothing more."""
        self._consumers = [consumer for consumer in self._consumers if consumer.owner is not owner]

    def update(self, now_ns: int) -> None:
        """After a step to ``now_ns``: measure if an update is due and wanted. Physics thread.

        An exception of a consumer disconnects its plugin and is reported; the others go on.
        """
        if not self._consumers or not self.update_rate.ready(now_ns):
            return
        # taken whether anybody wants it or not: the times of measurements must not depend on when somebody subscribed
        self.update_rate.take(now_ns)
        wanting = [consumer for consumer in self._consumers if consumer.wanted()]
        if not wanting:
            return
        self.measurement_ns = now_ns
        self.updates = Count(self.updates.number + 1, now_ns, time.monotonic_ns())
        for consumer in wanting:
            try:
                consumer.measure(self)
            except Exception as error:  # a plugin may raise anything; it must not take the world down
                self.disconnect_owner(consumer.owner)
                self._report(consumer.owner, error)

    def reset(self) -> None:
        self.update_rate.reset()
