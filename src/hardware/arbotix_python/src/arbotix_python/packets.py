"""Packets of the servo bus: 0xFF 0xFF id length kind parameters... checksum.

`kind` is an instruction on the way out and the error bits on the way back; length counts kind, parameters and checksum.
"""

import collections

Packet = collections.namedtuple("Packet", "id kind parameters")  # ints and a list of ints


def encode(index, kind, parameters):
    """The bytes of a packet for id `index`: its `kind`, an instruction, and `parameters`, bytes."""
    body = [index, len(parameters) + 2, kind, *parameters]
    return bytes([0xFF, 0xFF, *body, ~sum(body) & 0xFF])


def decode(read):
    """Reads one packet.

    :param read: function of a number of bytes that returns as many, or fewer when no more came in time.
    :returns: the Packet; None when nothing complete came, or its checksum was wrong.
    """
    headers = 0
    index = 0xFF
    while headers < 2 or index == 0xFF:  # an id is never 0xFF: longer runs are noise before the header
        byte = read(1)
        if not byte:
            return None
        if headers == 2:
            index = byte[0]
        else:
            headers = headers + 1 if byte[0] == 0xFF else 0
    length = read(1)
    if not length or length[0] < 2:
        return None
    rest = read(length[0])
    if len(rest) < length[0] or (index + length[0] + sum(rest)) & 0xFF != 0xFF:
        return None
    return Packet(index, rest[0], list(rest[1:-1]))
