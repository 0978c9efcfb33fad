"""sensor_msgs messages whose data stays where it is until it goes into the socket buffer."""

from __future__ import annotations

import struct

import sensor_msgs.msg


def _text(value: str) -> bytes:
    data = value.encode()
    return struct.pack("<I", len(data)) + data


class Image(sensor_msgs.msg.Image):
    """``data`` may be any buffer, such as shared memory; it is copied once, while the message is published."""

    def serialize(self, buff) -> None:
        self.header.serialize(buff)
        buff.write(
            struct.pack("<II", self.height, self.width)
            + _text(self.encoding)
            + struct.pack("<BII", self.is_bigendian, self.step, len(self.data))
        )
        buff.write(self.data)


class PointCloud2(sensor_msgs.msg.PointCloud2):
    """As :class:`Image`."""

    def serialize(self, buff) -> None:
        self.header.serialize(buff)
        buff.write(struct.pack("<III", self.height, self.width, len(self.fields)))
        for field in self.fields:
            buff.write(_text(field.name) + struct.pack("<IBI", field.offset, field.datatype, field.count))
        buff.write(struct.pack("<BIII", self.is_bigendian, self.point_step, self.row_step, len(self.data)))
        buff.write(self.data)
        buff.write(struct.pack("<B", self.is_dense))
