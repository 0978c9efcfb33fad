"""The bytes of Gazebo's transport, as far as ``gz topic`` says something itself: frames of 8 hexadecimal digits and as many bytes, and in
them messages of protobuf."""

from __future__ import annotations

import os
import socket
import time

_PATIENCE = 5.0  # s, for who listens to come, and for what was sent to be read


def field(number: int, value: int | str | bytes) -> bytes:
    """A field of a message.

    :param number: the field's, from 1
    :param value: text, bytes, or a whole number from 0 on
    """
    if isinstance(value, int):
        return _varint(number << 3) + _varint(value)
    data = value.encode() if isinstance(value, str) else value
    return _varint(number << 3 | 2) + _varint(len(data)) + data


def fields(data: bytes) -> dict[int, list]:
    """The values of a message by the numbers of their fields: whole numbers, or bytes. :raises ValueError: it is no message"""
    found: dict[int, list] = {}
    value: int | bytes
    at = 0
    try:
        while at < len(data):
            tag, at = _number(data, at)
            kind = tag & 7
            if kind == 0:
                value, at = _number(data, at)
            else:
                size, at = _number(data, at) if kind == 2 else ({1: 8, 5: 4}[kind], at)
                value, at = data[at : at + size], at + size
            found.setdefault(tag >> 3, []).append(value)
    except (IndexError, KeyError) as error:
        raise ValueError("no message of protobuf") from error
    return found


def master() -> tuple[str, int]:
    """Host and port of GAZEBO_MASTER_URI, which has been found good."""
    host, _, port = (os.environ.get("GAZEBO_MASTER_URI") or "localhost:11345").removeprefix("http://").rstrip("/").rpartition(":")
    return host, int(port)


class Wire:
    """A connection to the master or to another process."""

    def __init__(self, place: tuple[str, int] | socket.socket):
        self._socket = place if isinstance(place, socket.socket) else socket.create_connection(place, _PATIENCE)
        self._socket.settimeout(_PATIENCE)

    def __enter__(self) -> Wire:
        return self

    def __exit__(self, *_: object) -> None:
        self._socket.close()

    def send(self, data: bytes) -> None:
        self._socket.sendall(b"%8x" % len(data) + data)

    def tell(self, kind: str, message: bytes) -> None:
        """Send a packet.

        :param kind: what it is about, as ``advertise``
        :param message: of the type that goes with it
        """
        now = time.time_ns()
        stamp = field(1, now // 10**9) + field(2, now % 10**9)
        self.send(field(1, stamp) + field(2, kind) + field(3, message))

    def read(self, patience: float = _PATIENCE) -> bytes:
        """The next frame. :raises OSError: none came within ``patience`` s, or the connection has ended :raises ValueError: it is none"""
        end = time.monotonic() + patience
        return self._bytes(int(self._bytes(8, end), 16), end)

    def finish(self) -> None:
        """Wait until the other side has taken all that was sent, and has gone."""
        try:
            self._socket.shutdown(socket.SHUT_WR)
            while self._socket.recv(4096):
                pass
        except OSError:  # it is gone, or keeps the connection
            pass

    def own_host(self) -> str:
        """Where others reach this process: what the environment says, else the end of this connection."""
        for name in ("GAZEBO_HOSTNAME", "GAZEBO_IP"):
            try:
                if os.environ.get(name):
                    return socket.gethostbyname(os.environ[name])
            except OSError:
                pass
        return self._socket.getsockname()[0]

    def _bytes(self, count: int, end: float) -> bytes:
        data = b""
        while len(data) < count:
            self._socket.settimeout(max(0.001, end - time.monotonic()))
            part = self._socket.recv(count - len(data))
            if not part:
                raise ConnectionError("the connection has ended")
            data += part
        return data


def publish_once(topic: str, kind: str, message: bytes, listeners: int) -> int:
    """Say a message on a topic, to all who listen.

    :param topic: its full name
    :param kind: type of the message
    :param message: its bytes
    :param listeners: how many processes the master knows; they have 5 s to come
    :return: how many have got it
    :raises OSError: the master is gone
    """
    came: list[Wire] = []
    end = time.monotonic() + _PATIENCE
    with socket.create_server(("", 0)) as place, Wire(master()) as told:
        me = field(1, topic) + field(2, kind) + field(3, told.own_host()) + field(4, place.getsockname()[1])
        told.tell("advertise", me)
        while len(came) < listeners and time.monotonic() < end:
            place.settimeout(max(0.001, end - time.monotonic()))
            try:
                wire = Wire(place.accept()[0])
                if fields(fields(wire.read())[3][0])[1] == [topic.encode()]:
                    came.append(wire)
            except (OSError, ValueError, KeyError, TypeError):  # nobody in time, or somebody who speaks something else
                continue
        for wire in came:
            with wire:
                wire.send(message)
                wire.finish()
    return len(came)


def listen(topic: str, kind: str, publisher: str) -> Wire:
    """A connection on which the messages of a topic come from now on.

    :param topic: its full name
    :param kind: type of its messages
    :param publisher: host:port of who sends them
    :raises OSError: that one is gone
    """
    host, _, port = publisher.rpartition(":")
    wire = Wire((host, int(port)))
    wire.tell("sub", field(1, topic) + field(2, wire.own_host()) + field(3, 1) + field(4, kind) + field(5, 0))
    return wire


def _varint(value: int) -> bytes:
    out = b""
    while value > 127:
        out, value = out + bytes([value & 127 | 128]), value >> 7
    return out + bytes([value])


def _number(data: bytes, at: int) -> tuple[int, int]:
    value = shift = 0
    while True:
        value |= (data[at] & 127) << shift
        at, shift = at + 1, shift + 7
        if data[at - 1] < 128:
            return value, at
