"""How much memory waits in the sockets of this network: the kernel's own figures (sock_diag), without a program that asks for them."""

from __future__ import annotations

import socket
import struct
from collections.abc import Iterator

_NETLINK_SOCK_DIAG, _BY_FAMILY, _DUMP, _DONE, _ERROR = 4, 20, 0x301, 3, 2
_UNIX_MEMORY, _INET_MEMORY = 5, 7  # kinds of attributes
_HEADER, _ATTRIBUTE = struct.Struct("=IHHII"), struct.Struct("=HH")
_FIGURES = struct.Struct("=6I")  # read queue, its limit, sent, its limit, reserved, written
# (request, bytes before the attributes of an answer, kind of the attribute)
_ASKED = [(struct.pack("=BBHIII8s", socket.AF_UNIX, 0, 0, 0xFFFFFFFF, 0, 0x20, b"\xff" * 8), 16, _UNIX_MEMORY)] + [
    (struct.pack("=BBBBI48s", family, protocol, 1 << (_INET_MEMORY - 1), 0, 0xFFFFFFFF, b"\0" * 40 + b"\xff" * 8), 72, _INET_MEMORY)
    for family in (socket.AF_INET, socket.AF_INET6)
    for protocol in (socket.IPPROTO_TCP, socket.IPPROTO_UDP)
]


def queued() -> float:
    """Bytes, of all sockets; 0 where the kernel does not tell."""
    try:
        with socket.socket(socket.AF_NETLINK, socket.SOCK_RAW, _NETLINK_SOCK_DIAG) as asks:
            asks.settimeout(2.0)
            return float(
                sum(
                    read + max(sent, written)
                    for request, skip, kind in _ASKED
                    for read, sent, written in _answers(asks, request, skip, kind)
                )
            )
    except (OSError, struct.error):
        return 0.0


def _answers(asks: socket.socket, request: bytes, skip: int, wanted: int) -> Iterator[tuple[int, int, int]]:
    asks.send(_HEADER.pack(_HEADER.size + len(request), _BY_FAMILY, _DUMP, 1, 0) + request)
    while True:
        data, place = asks.recv(1 << 16), 0
        while place + _HEADER.size <= len(data):
            length, kind = _HEADER.unpack_from(data, place)[:2]
            if kind in (_DONE, _ERROR) or length < _HEADER.size:
                return
            at, end = place + _HEADER.size + skip, place + length
            while at + _ATTRIBUTE.size <= end:
                size, name = _ATTRIBUTE.unpack_from(data, at)
                if name == wanted:
                    figures = _FIGURES.unpack_from(data, at + _ATTRIBUTE.size)
                    yield figures[0], figures[2], figures[5]
                at += max((size + 3) & ~3, 4)
            place += (length + 3) & ~3
