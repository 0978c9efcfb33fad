"""Makes a rospy publisher fit for a loop that calls it 1000 times a second and more."""

from __future__ import annotations

import socket
import time

import rospy
from rospy.exceptions import TransportTerminated
from rospy.impl.tcpros_pubsub import QueuedConnection


class PromptConnection:
    """Writes to a subscriber at once, without the thread, the locks and the yielding of rospy's queued connections.

    It never waits either: a subscriber that has fallen behind by a whole socket buffer gets such a queued connection.

    :param connection: rospy's TCPROS transport, used by one thread at a time (rospy locks the publisher)
    :param queue_size: messages, of the queued connection
    """

    def __init__(self, connection, queue_size: int):
        self._connection = connection
        self._queue_size = queue_size
        self._queued: QueuedConnection | None = None

    def __getattr__(self, name: str):
        return getattr(self._connection, name)

    def write_data(self, data: bytes) -> bool:
        """Send ``data``, a message as bytes. :raises TransportTerminated: the subscriber is gone"""
        if self._queued is not None:
            return self._queued.write_data(data)
        connection = self._connection
        if connection.done or connection.socket is None:
            raise TransportTerminated("connection closed")
        try:
            sent = connection.socket.send(data, socket.MSG_DONTWAIT)
        except BlockingIOError:
            sent = 0
        except OSError as error:
            connection.close()
            raise TransportTerminated(str(error)) from error
        connection.stat_bytes += sent
        connection.stat_num_msg += 1
        if sent < len(data):
            self._queued = QueuedConnection(connection, self._queue_size)
            self._queued.write_data(data[sent:])
            while self._queued._queue:  # the other half of a message must not be dropped as the oldest of a full queue
                time.sleep(1e-4)
        return True


def make_prompt(publisher: rospy.Publisher, queue_size: int) -> rospy.Publisher:
    """Let ``publish`` of this publisher cost microseconds per subscriber. For small messages.

    :param queue_size: of a subscriber that has fallen behind
    """
    implementation = publisher.impl
    if "add_connection" in vars(implementation):  # done: all publishers of a topic in a process share this
        return publisher
    add = implementation.add_connection

    def add_prompt(connection):
        implementation.queue_size = None  # or rospy would wrap the connection; a second publisher sets it again
        return add(PromptConnection(connection, queue_size))

    implementation.add_connection = add_prompt
    return publisher
