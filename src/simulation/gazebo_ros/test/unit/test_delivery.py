"""What lock-step knows of the subscribers: connections with real sockets, without a ROS network."""

import socket
import threading
import time

import pytest
import realtime_tools.prompt
import rospy
import rospy.topics
from gazebo_ros import delivery as delivery_module
from gazebo_ros.delivery import Delivery
from rospy.impl.tcpros_pubsub import QueuedConnection

PICTURE = b"x" * 900_000


class Transport:
    """rospy's, as far as a queued connection needs it."""

    def __init__(self, name):
        with socket.socket() as listening:
            listening.bind(("localhost", 0))
            listening.listen()
            self.reader = socket.create_connection(listening.getsockname())
            self.socket, _ = listening.accept()
        self.name, self.endpoint_id, self.done = name, "/looks", False
        self._closed = None

    def set_cleanup_callback(self, f):
        self._closed = f

    def write_data(self, data):
        self.socket.sendall(data)

    def close(self):
        self.done = True
        self.reader.close()
        self.socket.close()
        self._closed(self)


@pytest.fixture
def delivery(monkeypatch):
    monkeypatch.setattr(rospy.topics, "QueuedConnection", QueuedConnection)
    monkeypatch.setattr(realtime_tools.prompt, "QueuedConnection", QueuedConnection)
    made = Delivery({"/rosout"})
    made.install()
    return made


@pytest.fixture
def lines(monkeypatch):
    said = []
    monkeypatch.setattr(rospy, "logwarn", lambda text, *arguments: said.append(text % arguments))
    return said


def connected(name="/picture", queue_size=1):
    """(transport, what rospy makes of it for a publisher with that queue)"""
    transport = Transport(name)
    return transport, rospy.topics.QueuedConnection(transport, queue_size)


def read(transport, size):
    """In a thread; done when so many bytes have come."""

    def run():
        left = size
        while left:
            left -= len(transport.reader.recv(1 << 20))

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    return thread


def until(condition):
    end = time.monotonic() + 30
    while not condition():
        assert time.monotonic() < end, "it does not happen"
        time.sleep(0.005)


def test_nothing_is_dropped_and_all_of_it_is_waited_for(delivery):
    transport, connection = connected()
    for _ in range(40):
        connection.write_data(PICTURE)
    delivery.wait(0.05)
    assert delivery.pending and not delivery.taken()  # nobody has read yet
    reader = read(transport, 40 * len(PICTURE))
    until(lambda: (delivery.wait(0.1), not delivery.pending)[1])
    reader.join(30)
    assert not reader.is_alive()
    transport.close()


def test_a_closed_connection_is_not_waited_for(delivery):
    transport, connection = connected()
    for _ in range(20):
        connection.write_data(PICTURE)
    transport.close()
    until(lambda: (delivery.wait(0.01), not delivery.pending)[1])


def test_the_log_is_left_out(delivery):
    transport, connection = connected("/rosout")
    assert type(connection) is QueuedConnection
    transport.close()


def test_who_holds_it_up_is_told_and_who_hangs_is_given_up(delivery, lines, monkeypatch):
    monkeypatch.setattr(delivery_module, "_TOLD_AFTER", 0.1)
    monkeypatch.setattr(delivery_module, "_HANGS_AFTER", 0.5)
    transport, connection = connected()
    for _ in range(20):
        connection.write_data(PICTURE)
    until(lambda: (delivery.wait(0.01), not delivery.pending)[1])
    assert len(lines) == 2, lines
    assert "the simulation stood still" in lines[0] and "/looks takes /picture more slowly" in lines[0]
    assert "/looks has taken nothing of /picture" in lines[1]
    for _ in range(100):
        connection.write_data(PICTURE)
    assert not delivery.pending and connection.count < 25  # what it cannot have is not gathered
    threading.Thread(target=lambda: [None for _ in iter(lambda: transport.reader.recv(1 << 20), b"")], daemon=True).start()
    until(lambda: not connection.given_up and not delivery.pending)  # it reads on, and is waited for anew
    connection.write_data(PICTURE)
    until(lambda: not delivery.pending)
    assert not connection.count
    transport.close()


def test_one_that_is_slow_is_never_given_up(delivery, lines, monkeypatch):
    monkeypatch.setattr(delivery_module, "_HANGS_AFTER", 0.5)
    transport, connection = connected()
    for _ in range(12):
        connection.write_data(PICTURE)

    def sip():
        left = 12 * len(PICTURE)
        while left:
            left -= len(transport.reader.recv(1 << 19))
            time.sleep(0.05)

    thread = threading.Thread(target=sip, daemon=True)
    thread.start()
    until(lambda: (delivery.wait(0.01), not delivery.pending)[1])
    thread.join(30)
    assert not thread.is_alive() and not any("not waited for" in line for line in lines)
    transport.close()
