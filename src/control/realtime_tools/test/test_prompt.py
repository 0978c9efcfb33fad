"""Messages reach subscribers at once, whole and in order, and a subscriber that does not read holds nobody up."""

import socket

import pytest
from realtime_tools.prompt import PromptConnection
from rospy.exceptions import TransportTerminated


class Transport:
    """What PromptConnection uses of a TCPROS transport."""

    def __init__(self, end):
        self.socket = end
        self.done = False
        self.stat_bytes = self.stat_num_msg = 0

    def set_cleanup_callback(self, callback):
        pass

    def close(self):
        self.done = True

    def write_data(self, data):
        self.socket.sendall(data)


@pytest.fixture
def ends():
    near, far = socket.socketpair()
    far.settimeout(60.0)
    yield Transport(near), far
    near.close()
    far.close()


def read(end, size):
    data = b""
    while len(data) < size:
        data += end.recv(size - len(data))
    return data


def test_a_message_is_there_when_write_returns(ends):
    transport, far = ends
    PromptConnection(transport, 10).write_data(b"0123456789ab")
    assert far.recv(100, socket.MSG_DONTWAIT) == b"0123456789ab"


def test_a_subscriber_that_stands_still_loses_messages_but_never_part_of_one(ends):
    transport, far = ends
    connection = PromptConnection(transport, 10)
    message = 1000
    count = 5000
    for number in range(count):  # more than any socket buffer of this machine takes
        connection.write_data(number.to_bytes(4, "little") * (message // 4))
    numbers = []
    while not numbers or numbers[-1] != count - 1:  # the newest comes through
        data = read(far, message)
        assert len(set(zip(*[iter(data)] * 4))) == 1, "halves of different messages"
        numbers.append(int.from_bytes(data[:4], "little"))
    assert numbers == sorted(set(numbers)) and len(numbers) < count
    transport.done = True
    with connection._queued._lock:
        connection._queued._cond_data_available.notify()


def test_a_subscriber_that_is_gone_is_reported(ends):
    transport, far = ends
    connection = PromptConnection(transport, 10)
    far.close()
    with pytest.raises(TransportTerminated):
        connection.write_data(b"x")
        connection.write_data(b"x")
    assert transport.done
    with pytest.raises(TransportTerminated):
        connection.write_data(b"x")


def test_it_answers_for_its_transport(ends):
    transport, _ = ends
    transport.endpoint_id = "/listener"
    assert PromptConnection(transport, 10).endpoint_id == "/listener"
