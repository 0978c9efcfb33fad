"""Bytes of a message of ROS 1 as those of ROS 2, and back, field by field; long data goes as one piece.

ROS 1 packs values without gaps. ROS 2 (CDR, little endian, after four bytes of a header) aligns a number to its size, ends a text with a
zero and gives a message without fields one byte. Needs neither ROS.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any

from ros1_bridge.errors import MappingError
from ros1_bridge.types import FORMATS, RULES, SIZES, Field, Types, shared

HEADER = b"\x00\x01\x00\x00"
_LENGTH = struct.Struct("<I")
Read = Callable[[memoryview, int], tuple[Any, int]]
Write = Callable[[bytearray, Any], None]
TIMES = ("time", "duration")  # two numbers of four bytes, the same in both


class Codec:
    """How one kind of value is read and written. A value is whatever the two sides of one codec understand."""

    def read1(self, data: memoryview, at: int) -> tuple[Any, int]:
        raise NotImplementedError

    def read2(self, data: memoryview, at: int) -> tuple[Any, int]:
        raise NotImplementedError

    def write1(self, out: bytearray, value: Any) -> None:
        raise NotImplementedError

    def write2(self, out: bytearray, value: Any) -> None:
        raise NotImplementedError

    zero: Any = None  # what a field has that the other side does not know


class Flat(Codec):
    """Numbers of one size one after the other: the same bytes in both."""

    def __init__(self, width: int, size: int) -> None:
        self.width, self.size, self.zero = width, size, bytes(size)

    def read1(self, data: memoryview, at: int) -> tuple[Any, int]:
        return data[at : at + self.size], at + self.size

    def read2(self, data: memoryview, at: int) -> tuple[Any, int]:
        return self.read1(data, at + -at % self.width)

    def write1(self, out: bytearray, value: Any) -> None:
        out += value

    def write2(self, out: bytearray, value: Any) -> None:
        align(out, self.width)
        out += value


class Converted(Codec):
    """A number of another type on the other side; what does not fit is an error."""

    zero = 0

    def __init__(self, one: str, two: str) -> None:
        self._one, self._two, self._whole = struct.Struct("<" + FORMATS[one]), struct.Struct("<" + FORMATS[two]), (_whole(one), _whole(two))

    def read1(self, data: memoryview, at: int) -> tuple[Any, int]:
        return self._one.unpack_from(data, at)[0], at + self._one.size

    def read2(self, data: memoryview, at: int) -> tuple[Any, int]:
        at += -at % self._two.size
        return self._two.unpack_from(data, at)[0], at + self._two.size

    def write1(self, out: bytearray, value: Any) -> None:
        out += self._one.pack(int(value) if self._whole[0] else value)

    def write2(self, out: bytearray, value: Any) -> None:
        align(out, self._two.size)
        out += self._two.pack(int(value) if self._whole[1] else value)


class Text(Codec):
    zero = b""

    def __init__(self, bound: int | None) -> None:
        self._bound = bound

    def read1(self, data: memoryview, at: int) -> tuple[Any, int]:
        (length,) = _LENGTH.unpack_from(data, at)
        return bytes(data[at + 4 : at + 4 + length]), at + 4 + length

    def read2(self, data: memoryview, at: int) -> tuple[Any, int]:
        value, at = self.read1(data, at + -at % 4)
        return value[:-1], at

    def write1(self, out: bytearray, value: Any) -> None:
        out += _LENGTH.pack(len(value))
        out += value

    def write2(self, out: bytearray, value: Any) -> None:
        if not value.isascii():  # ROS 1 takes any bytes; a node of ROS 2 in Python ends at what is no UTF-8
            value = value.decode("utf-8", "replace").encode()
        if self._bound is not None and len(value) > self._bound:
            raise MappingError(f"a text of {len(value)} bytes where ROS 2 takes {self._bound}")
        align(out, 4)
        out += _LENGTH.pack(len(value) + 1)
        out += value
        out.append(0)


class Array(Codec):
    """Sequences, and arrays of a fixed length, of one codec. A value is a list, or the bytes of flat elements."""

    def __init__(self, element: Codec, one: int, two: int, bound: int | None) -> None:
        self._element, self._one, self._two, self._bound = element, one, two, bound
        self.zero = element.zero * two if isinstance(element, Flat) else [element.zero] * two

    def _read(self, data: memoryview, at: int, count: int, read: Read) -> tuple[Any, int]:
        if isinstance(self._element, Flat):
            if not count:
                return b"", at
            first, start = read(data, at)
            at = start - self._element.size
            end = at + count * self._element.size
            return data[at:end], end
        values = []
        for _ in range(count):
            if at > len(data):
                raise MappingError("it ends within a list")
            value, at = read(data, at)
            values.append(value)
        return values, at

    def read1(self, data: memoryview, at: int) -> tuple[Any, int]:
        count = self._one
        if not count:
            (count,) = _LENGTH.unpack_from(data, at)
            at += 4
        return self._read(data, at, count, self._element.read1)

    def read2(self, data: memoryview, at: int) -> tuple[Any, int]:
        count = self._two
        if not count:
            at += -at % 4
            (count,) = _LENGTH.unpack_from(data, at)
            at += 4
        return self._read(data, at, count, self._element.read2)

    def _count(self, value: Any, fixed: int) -> int:
        count = len(value) // self._element.size if isinstance(self._element, Flat) else len(value)
        if fixed and count != fixed:
            raise MappingError(f"a list of {count} where the other side takes {fixed}")
        return count

    def write1(self, out: bytearray, value: Any) -> None:
        count = self._count(value, self._one)
        if not self._one:
            out += _LENGTH.pack(count)
        if isinstance(self._element, Flat):
            out += value
        else:
            for one in value:
                self._element.write1(out, one)

    def write2(self, out: bytearray, value: Any) -> None:
        count = self._count(value, self._two)
        if self._bound is not None and count > self._bound:
            raise MappingError(f"a list of {count} where ROS 2 takes {self._bound}")
        if not self._two:
            align(out, 4)
            out += _LENGTH.pack(count)
        if isinstance(self._element, Flat):
            if count:
                self._element.write2(out, value)
        else:
            for one in value:
                self._element.write2(out, one)


class Struct(Codec):
    """A message. Values are by ROS 1's name of the field; a side's own fields are passed over and written as zero."""

    def __init__(self, one: list[tuple[str | None, Codec]], two: list[tuple[str | None, Codec]]) -> None:
        self._one, self._two, self.zero = one, two, {}

    def read1(self, data: memoryview, at: int) -> tuple[Any, int]:
        values = {}
        for name, codec in self._one:
            values[name], at = codec.read1(data, at)
        return values, at

    def read2(self, data: memoryview, at: int) -> tuple[Any, int]:
        values = {}
        for name, codec in self._two:
            values[name], at = codec.read2(data, at)
        return values, at if self._two else at + 1

    def write1(self, out: bytearray, value: Any) -> None:
        for name, codec in self._one:
            codec.write1(out, value[name] if name is not None and name in value else codec.zero)

    def write2(self, out: bytearray, value: Any) -> None:
        for name, codec in self._two:
            codec.write2(out, value[name] if name is not None and name in value else codec.zero)
        if not self._two:
            out.append(0)


def align(out: bytearray, width: int) -> None:
    gap = (4 - len(out)) % width  # from the end of the header on
    if gap:
        out += bytes(gap)


def _whole(kind: str) -> bool:
    return not kind.startswith("float")


class Pair:
    """A type of ROS 1 and its counterpart.

    :param one, two: the types of each side, nested ones included
    :raises MappingError: they are no pair
    """

    def __init__(self, type_of_ros1: str, one: Types, type_of_ros2: str, two: Types) -> None:
        self.ros1, self.ros2, self._types = type_of_ros1, type_of_ros2, (one, two)
        self._made: dict[tuple[str, str], Codec] = {}
        self._codec = self._message(type_of_ros1, type_of_ros2)

    def to_ros2(self, data: bytes | memoryview) -> bytearray:
        """:raises MappingError: these bytes are no such message"""
        out = bytearray(HEADER)
        self._codec.write2(out, self._read(self._codec.read1, memoryview(data), False))
        return out

    def to_ros1(self, data: bytes | memoryview) -> bytearray:
        """:raises MappingError:"""
        if bytes(data[:2]) != HEADER[:2]:
            raise MappingError(f"{self.ros2}: bytes of encoding {bytes(data[:2]).hex()}, and only CDR of little endian (0001) is known")
        out = bytearray()
        self._codec.write1(out, self._read(self._codec.read2, memoryview(data)[4:], True))
        return out

    def _read(self, read: Read, data: memoryview, padded: bool) -> Any:
        """``padded``: bytes may follow; ROS 2's serializer leaves room that it has reckoned with."""
        try:
            value, end = read(data, 0)
        except struct.error:
            end = len(data) + 1
        if end > len(data) or end < len(data) and not padded:
            raise MappingError(f"{len(data)} bytes are no {self.ros2 if padded else self.ros1}")
        return value

    def _fields(self, side: int, kind: str) -> tuple[Field, ...]:
        if kind not in self._types[side]:
            raise MappingError(f"ROS {side + 1} has no {kind} here")
        return self._types[side][kind]

    def _message(self, one: str, two: str) -> Codec:
        key = (one, two)
        if key not in self._made:
            if two in ("builtin_interfaces/Time", "builtin_interfaces/Duration"):
                self._made[key] = Flat(4, 8)
            else:
                flat = self._flat(one, two)
                self._made[key] = flat or self._structure(one, two)
        return self._made[key]

    def _flat(self, one: str, two: str) -> Flat | None:
        first, second = self._leaves(0, one), self._leaves(1, two)
        if first and first == second and len({width for _, width in first}) == 1:
            return Flat(first[0][1], sum(width for _, width in first))
        return None

    def _leaves(self, side: int, kind: str) -> list[tuple[str, int]]:
        """Numbers of which a message consists, by name and size, [] where it has others."""
        found: list[tuple[str, int]] = []
        for field in self._fields(side, kind):
            if field.kind in SIZES:
                part = [(f"{field.name.lower()} {FORMATS[field.kind].replace('b', 'B')}", SIZES[field.kind])]
            elif field.kind in TIMES or field.many == 0 or "/" not in field.kind:
                return []
            else:
                part = [(f"{field.name.lower()}.{name}", width) for name, width in self._leaves(side, field.kind)]
            if field.many == 0 or not part:
                return []
            found += part * (field.many or 1)
        return found

    def _structure(self, one: str, two: str) -> Struct:
        first, second = self._fields(0, one), self._fields(1, two)
        names = shared(one, first, second)
        if names is None:
            raise MappingError(f"{one} of ROS 1 and {two} of ROS 2 have different fields")
        of_one = {field.name: field for field in first}
        codecs = {}
        for field in second:
            name = names.get(field.name)
            if name is not None and "." not in name:
                codecs[field.name] = self._field(of_one[name], field)
        if one in RULES and RULES[one][1]:
            return self._ruled(first, second, codecs)
        back = {name: codecs[two_name] for two_name, name in names.items()}
        return Struct(
            [(f.name, back[f.name]) if f.name in back else (None, self._alone(0, f)) for f in first],
            [(names[f.name], codecs[f.name]) if f.name in names else (None, self._alone(1, f)) for f in second],
        )

    def _ruled(self, first: tuple[Field, ...], second: tuple[Field, ...], codecs: dict[str, Codec]) -> Struct:
        """rosgraph_msgs/Log: ROS 2 has the header's stamp alone."""
        stamp = Flat(4, 8)
        header = _Stamp(stamp, Text(None))
        return Struct(
            [(f.name, header if f.name == "header" else codecs.get(f.name) or self._alone(0, f)) for f in first],
            [("header", stamp) if f.name == "stamp" else (f.name, codecs[f.name]) for f in second],
        )

    def _field(self, one: Field, two: Field) -> Codec:
        if (one.many is None) != (two.many is None):
            raise MappingError(f"{one.name}: a list on one side alone")
        if one.kind in SIZES and two.kind in SIZES:
            element: Codec = Flat(SIZES[one.kind], SIZES[one.kind]) if _alike(one.kind, two.kind) else Converted(one.kind, two.kind)
        elif one.kind in TIMES and one.kind == two.kind:
            element = Flat(4, 8)
        elif one.kind == two.kind == "string":
            element = Text(two.bound if two.many is None else None)
        elif "/" in one.kind and "/" in two.kind:
            element = self._message(one.kind, two.kind)
        else:
            raise MappingError(f"{one.name}: {one.kind} in ROS 1, {two.kind} in ROS 2")
        return element if one.many is None else Array(element, one.many, two.many or 0, two.bound)

    def _alone(self, side: int, field: Field) -> Codec:
        """A field that only this side has."""
        if field.kind in SIZES:
            element: Codec = Flat(SIZES[field.kind], SIZES[field.kind])
        elif field.kind in TIMES:
            element = Flat(4, 8)
        elif field.kind == "string":
            element = Text(None)
        elif "/" in field.kind:
            parts: list[tuple[str | None, Codec]] = [(None, self._alone(side, inner)) for inner in self._fields(side, field.kind)]
            element = Struct(parts, parts)
        else:
            raise MappingError(f"{field.name} is a {field.kind}, which ROS 1 has not")
        return element if field.many is None else Array(element, field.many, field.many, None)


class _Stamp(Codec):
    """A header of ROS 1 of which only the stamp counts."""

    def __init__(self, stamp: Flat, text: Text) -> None:
        self._stamp, self._text, self.zero = stamp, text, stamp.zero

    def read1(self, data: memoryview, at: int) -> tuple[Any, int]:
        stamp, at = self._stamp.read1(data, at + 4)
        return stamp, self._text.read1(data, at)[1]

    def write1(self, out: bytearray, value: Any) -> None:
        out += bytes(4)
        out += value
        out += bytes(4)


def _alike(one: str, two: str) -> bool:
    return FORMATS[one].replace("b", "B") == FORMATS[two].replace("b", "B")
