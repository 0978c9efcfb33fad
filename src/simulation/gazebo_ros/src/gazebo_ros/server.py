"""The step loop: what is called when, and how other threads get at the world."""
from __future__ import annotations

import queue
import threading
from concurrent.futures import Future
from typing import Any, Callable, List, Optional, Tuple

import rospy

from gazebo_ros.throttle import Throttle

_NS = 1_000_000_000


class Connection:
    """A callback of the step loop; :meth:`disconnect` ends it."""

    __slots__ = ("f", "owner", "_disconnect")

    def __init__(self, f: Callable[[], None], owner: Any, disconnect: Callable[[Connection], None]):
        self.f = f
        self.owner = owner
        self._disconnect = disconnect

    def disconnect(self) -> None:
        self._disconnect(self)


class CallbackList:
    """Callbacks in connection order. May change while it is being called; the change counts from the next step on."""

    def __init__(self):
        self.connections: Tuple[Connection, ...] = ()

    def connect(self, f: Callable[[], None], owner: Any = None) -> Connection:
        connection = Connection(f, owner, self.disconnect)
        self.connections += (connection,)
        return connection

    def disconnect(self, connection: Connection) -> None:
        self.connections = tuple(c for c in self.connections if c is not connection)

    def disconnect_owner(self, owner: Any) -> None:
        self.connections = tuple(c for c in self.connections if c.owner is not owner)


class Stopped(RuntimeError):
    """The simulator is shutting down; the call was not made."""


class Server:
    """One simulated world, stepped in one thread.

    ``world``
        ``ode_sim.World``. Only the physics thread may touch it: inside step callbacks, ``load``, ``reset`` and
        ``shutdown`` of plugins, and functions given to :meth:`call`.
    """

    def __init__(self, world, throttle: Optional[Throttle] = None):
        self.world = world
        self.throttle = throttle or Throttle(world.physics.real_time_update_rate)
        self.paused = False
        self._calls: queue.SimpleQueue = queue.SimpleQueue()
        self._thread: Optional[int] = None
        self._before = CallbackList()
        self._after = CallbackList()
        self._now = rospy.Time(*divmod(world.time_ns, _NS))

    # ------------------------------------------------------------------------------------------ for plugins

    def now(self) -> rospy.Time:
        """Sim time of the current step (of the last one, between steps)."""
        return self._now

    def before_step(self, f: Callable[[], None]) -> Connection:
        """Call ``f()`` in every step before collision and dynamics, after sim time has advanced."""
        return self._before.connect(f)

    def after_step(self, f: Callable[[], None]) -> Connection:
        """Call ``f()`` in every step when poses, velocities and contacts are those at :meth:`now`."""
        return self._after.connect(f)

    def call(self, f: Callable[[], Any]) -> Any:
        """Run ``f()`` in the physics thread between two steps, also while paused, and return its result.

        An exception of ``f`` is raised here. From the physics thread itself ``f`` runs at once.

        :raises Stopped: the simulator is shutting down
        """
        if threading.get_ident() == self._thread:
            return f()
        future: Future = Future()
        self._calls.put((f, future))
        return future.result()
