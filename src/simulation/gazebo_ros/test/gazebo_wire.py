"""The bytes of Gazebo's transport, written and read by hand: who else speaks it must understand them."""

import socket


def varint(value):
    out = b""
    while value > 127:
        out, value = out + bytes([value & 127 | 128]), value >> 7
    return out + bytes([value])


def field(number, value):
    """A field of a protobuf message: text, bytes or a whole number."""
    if isinstance(value, int):
        return varint(number << 3) + varint(value)
    data = value.encode() if isinstance(value, str) else value
    return varint(number << 3 | 2) + varint(len(data)) + data


def fields(data):
    """{number: [values]} of a message without fixed-size fields."""

    def number(at):
        value = shift = 0
        while True:
            value |= (data[at] & 127) << shift
            at, shift = at + 1, shift + 7
            if data[at - 1] < 128:
                return value, at

    found, at = {}, 0
    while at < len(data):
        tag, at = number(at)
        value, at = number(at)
        if tag & 7 == 2:
            value, at = data[at : at + value], at + value
        found.setdefault(tag >> 3, []).append(value)
    return found


def packet(kind, message):
    return field(1, field(1, 5) + field(2, 6)) + field(2, kind) + field(3, message)


class Wire:
    """A connection: frames of 8 hexadecimal digits and as many bytes."""

    def __init__(self, port, receive_buffer=0):
        self.socket = socket.socket()
        if receive_buffer:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self.socket.settimeout(60)
        self.socket.connect(("localhost", port))

    def send(self, data):
        self.socket.sendall(b"%8x" % len(data) + data)

    def tell(self, kind, message):
        self.send(packet(kind, message))

    def bytes(self, count):
        data = b""
        while len(data) < count:
            part = self.socket.recv(count - len(data))
            if not part:
                raise EOFError
            data += part
        return data

    def read(self):
        header = self.bytes(8)
        assert header == b"%8x" % int(header, 16), header
        return self.bytes(int(header, 16))

    def packet(self, kind=None):
        """(type, message) of the next packet, or of the next of this type."""
        while True:
            found = fields(self.read())
            if kind in (None, found[2][0].decode()):
                return found[2][0].decode(), found[3][0]

    def close(self):
        self.socket.close()
