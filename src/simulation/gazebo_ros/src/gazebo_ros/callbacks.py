"""Callbacks of the step loop, and whose they are."""

from __future__ import annotations

import threading
from collections.abc import Callable

import rospy

from gazebo_ros.plugin_host import PluginInstance


class Connection:
    """A callback of the step loop; :meth:`disconnect` ends it."""

    __slots__ = ("f", "owner", "_callbacks")

    def __init__(self, f: Callable[[], None], owner: PluginInstance | None, callbacks: CallbackList):
        self.f = f
        self.owner = owner
        self._callbacks = callbacks

    def disconnect(self) -> None:
        self._callbacks.disconnect(self)


class Occasional:
    """A callback of the step loop that is connected only while there is something to do.

    :param connect: ``server.before_step`` or ``server.after_step``
    """

    def __init__(self, connect: Callable[[Callable[[], None]], Connection], f: Callable[[], None]):
        self._connect = connect
        self._f = f
        self._connection: Connection | None = None

    @property
    def connected(self) -> bool:
        return self._connection is not None

    def needed(self, needed: bool) -> None:
        """Connect it where it is ``needed``, else not, from the next step on."""
        if needed and self._connection is None:
            self._connection = self._connect(self._f)
        elif not needed and self._connection is not None:
            self._connection.disconnect()
            self._connection = None


class CallbackList:
    """Callbacks in connection order, of any thread. A change counts from the next step on."""

    def __init__(self):
        self.connections: tuple[Connection, ...] = ()
        self._lock = threading.Lock()

    def connect(self, f: Callable[[], None], owner: PluginInstance | None = None) -> Connection:
        """Call ``f`` from the next step on. :return: what ends that

        :param owner: the plugin that is told of an error of ``f``, which ends the calls; None: the server's own callback
        """
        connection = Connection(f, owner, self)
        with self._lock:
            self.connections += (connection,)
        return connection

    def disconnect(self, connection: Connection) -> None:
        """End ``connection``."""
        with self._lock:
            self.connections = tuple(c for c in self.connections if c is not connection)

    def disconnect_owner(self, owner: PluginInstance) -> None:
        """End all connections of ``owner``."""
        with self._lock:
            self.connections = tuple(c for c in self.connections if c.owner is not owner)

    def call(self) -> None:
        for connection in self.connections:
            try:
                connection.f()
            except Exception as error:  # a plugin may raise anything; it must not take the world down
                self.disconnect(connection)
                if connection.owner is None:
                    rospy.logerr("the simulator's own callback %r failed and is switched off: %r", connection.f, error)
                else:
                    connection.owner.report(error)
