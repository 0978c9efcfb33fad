"""Bytes of a message of ROS 1 as those of ROS 2, and back, field by field; long data goes as one piece.

ROS 1 packs values without gaps. ROS 2 (CDR, little endian, after four bytes of a header) aligns a number to its size, ends a text with a
zero and gives a message without fields one byte. Needs neither ROS.
"""

from __future__ import annotations

import struct
from dataclasses import replace
from typing import Any

from ros1_bridge.errors import MappingError
from ros1_bridge.types import FORMATS, SIZES, Field, Types, shared

HEADER = b"\x00\x01\x00\x00"
_LENGTH = struct.Struct("<I")
TIMES = ("time", "duration")  # two numbers of four bytes, the same in both


class Codec:
    """One kind of value as one side writes it. The two codecs of a field, one for each side, understand the same values.

    :param align: a value begins at a multiple of this many bytes; it is 1 in all of ROS 1
    """

    zero: Any = None  # what a field has that the other side does not know

    def __init__(self, align: int) -> None:
        self.align = align
        self.gaps = [bytes(-length % align) for length in range(align)]  # by the length of what is before

    def read(self, data: memoryview, at: int) -> tuple[Any, int]:
        """The value that begins in ``data``, or after a gap, at the byte ``at``, counted from the end of the header; and where it ends."""
        raise NotImplementedError

    def write(self, out: bytearray, value: Any) -> None:
        """Add ``value`` to ``out``, the bytes up to here, in ROS 2 with their header of four; what does not fit is a MappingError."""
        raise NotImplementedError


class Flat(Codec):
    """Numbers of one size one after the other: the same bytes in both."""

    def __init__(self, align: int, size: int) -> None:
        super().__init__(align)
        self.size, self.zero = size, bytes(size)

    def read(self, data: memoryview, at: int) -> tuple[Any, int]:
        at += -at % self.align
        end = at + self.size
        return data[at:end], end

    def write(self, out: bytearray, value: Any) -> None:
        if self.align > 1:
            out += self.gaps[(len(out) - 4) % self.align]
        out += value


class Converted(Codec):
    """A number of another type on the other side; what does not fit is an error."""

    zero = 0

    def __init__(self, align: int, kind: str) -> None:
        super().__init__(align)
        self._form, self._whole = struct.Struct("<" + FORMATS[kind]), not kind.startswith("float")

    def read(self, data: memoryview, at: int) -> tuple[Any, int]:
        at += -at % self.align
        return self._form.unpack_from(data, at)[0], at + self._form.size

    def write(self, out: bytearray, value: Any) -> None:
        out += self.gaps[(len(out) - 4) % self.align]
        out += self._form.pack(int(value) if self._whole else value)


class Text(Codec):
    """:param end: what stands behind the letters, and counts as one: a zero in ROS 2, where a text may have a bound, too"""

    zero = b""

    def __init__(self, align: int, end: bytes, bound: int | None) -> None:
        super().__init__(align)
        self._end, self._more, self._bound = end, len(end), bound

    def read(self, data: memoryview, at: int) -> tuple[Any, int]:
        at += 4 + -at % self.align
        end = at + _LENGTH.unpack_from(data, at - 4)[0]
        return bytes(data[at : end - self._more]), end

    def write(self, out: bytearray, value: Any) -> None:
        if self._end:
            if not value.isascii():  # ROS 1 takes any bytes; a node of ROS 2 in Python ends at what is no UTF-8
                value = value.decode("utf-8", "replace").encode()
            if self._bound is not None and len(value) > self._bound:
                raise MappingError(f"a text of {len(value)} bytes where ROS 2 takes {self._bound}")
            out += self.gaps[(len(out) - 4) % self.align]
        out += _LENGTH.pack(len(value) + self._more)
        out += value
        out += self._end


class Array(Codec):
    """Sequences, and arrays of a fixed length, of one codec. A value is a list, or the bytes of flat elements.

    :param fixed: how many there are; 0: as many as a number before them says
    """

    def __init__(self, align: int, element: Codec, fixed: int, bound: int | None) -> None:
        super().__init__(align)
        self._element, self._fixed, self._bound = element, fixed, bound
        self._size = element.size if isinstance(element, Flat) else 0
        self.zero = element.zero * fixed if self._size else [element.zero] * fixed

    def read(self, data: memoryview, at: int) -> tuple[Any, int]:
        count = self._fixed
        if not count:
            at += 4 + -at % self.align
            (count,) = _LENGTH.unpack_from(data, at - 4)
        if self._size:
            if count:  # without elements there is no gap before them
                at += -at % self._element.align
            end = at + count * self._size
            return data[at:end], end
        values, read = [], self._element.read
        for _ in range(count):
            if at > len(data):
                raise MappingError("it ends within a list")
            value, at = read(data, at)
            values.append(value)
        return values, at

    def write(self, out: bytearray, value: Any) -> None:
        count = len(value) // self._size if self._size else len(value)
        if self._fixed and count != self._fixed:
            raise MappingError(f"a list of {count} where the other side takes {self._fixed}")
        if self._bound is not None and count > self._bound:
            raise MappingError(f"a list of {count} where ROS 2 takes {self._bound}")
        if not self._fixed:
            out += self.gaps[(len(out) - 4) % self.align]
            out += _LENGTH.pack(count)
        write = self._element.write
        if not self._size:
            for one in value:
                write(out, one)
        elif count:
            write(out, value)


class Struct(Codec):
    """A message. Values are by ROS 1's name of the field; a side's own fields are passed over and written as zero.

    :param filler: bytes of a message without fields
    """

    def __init__(self, fields: list[tuple[str, Codec]], filler: int) -> None:
        super().__init__(1)
        self._filler, self.zero = bytes(0 if fields else filler), {}
        self._fields = [(name, codec.read, codec.write, codec.zero) for name, codec in fields]

    def read(self, data: memoryview, at: int) -> tuple[Any, int]:
        values = {}
        for name, read, _, _ in self._fields:
            values[name], at = read(data, at)
        return values, at + len(self._filler)

    def write(self, out: bytearray, value: Any) -> None:
        for name, _, write, zero in self._fields:
            write(out, value.get(name, zero))
        out += self._filler


class Pair:
    """A type of ROS 1 and its counterpart.

    :param one, two: the types of each side, nested ones included
    :raises MappingError: they are no pair
    """

    def __init__(self, type_of_ros1: str, one: Types, type_of_ros2: str, two: Types) -> None:
        self.ros1, self.ros2, self._types = type_of_ros1, type_of_ros2, (one, two)
        self._made: dict[tuple[str, str], tuple[Codec, Codec]] = {}
        self._one, self._two = self._message(type_of_ros1, type_of_ros2)

    def to_ros2(self, data: bytes | memoryview) -> bytearray:
        """:raises MappingError: these bytes are no such message"""
        out = bytearray(HEADER)
        self._two.write(out, self._read(self._one, memoryview(data), self.ros1, False))
        return out

    def to_ros1(self, data: bytes | memoryview) -> bytearray:
        """:raises MappingError:"""
        if bytes(data[:2]) != HEADER[:2]:
            raise MappingError(f"{self.ros2}: bytes of encoding {bytes(data[:2]).hex()}, and only CDR of little endian (0001) is known")
        out = bytearray()
        self._one.write(out, self._read(self._two, memoryview(data)[4:], self.ros2, True))
        return out

    def _read(self, codec: Codec, data: memoryview, kind: str, padded: bool) -> Any:
        """``padded``: bytes may follow; ROS 2's serializer leaves room that it has reckoned with."""
        try:
            value, end = codec.read(data, 0)
        except struct.error:
            end = len(data) + 1
        if end > len(data) or end < len(data) and not padded:
            raise MappingError(f"{len(data)} bytes are no {kind}")
        return value

    def _fields(self, side: int, kind: str) -> tuple[Field, ...]:
        if kind not in self._types[side]:
            raise MappingError(f"ROS {side + 1} has no {kind} here")
        return self._types[side][kind]

    def _message(self, one: str, two: str) -> tuple[Codec, Codec]:
        if (one, two) not in self._made:
            first, second = self._leaves(0, one), self._leaves(1, two)
            if two in ("builtin_interfaces/Time", "builtin_interfaces/Duration"):
                self._made[one, two] = Flat(1, 8), Flat(4, 8)
            elif first and first == second and len({SIZES[kind] for _, kind in first}) == 1:
                width = SIZES[first[0][1]]
                self._made[one, two] = Flat(1, width * len(first)), Flat(width, width * len(first))
            else:
                self._made[one, two] = self._structure(one, two)
        return self._made[one, two]

    def _leaves(self, side: int, kind: str) -> list[tuple[str, str]]:
        """Numbers of which a message consists, by name and type, [] where it has others."""
        found: list[tuple[str, str]] = []
        for field in self._fields(side, kind):
            part = [("", _alike(field.kind))] if field.kind in SIZES else self._leaves(side, field.kind) if "/" in field.kind else []
            if field.many == 0 or not part:
                return []
            found += [(f"{field.name.lower()}.{name}", inner) for name, inner in part] * (field.many or 1)
        return found

    def _structure(self, one: str, two: str) -> tuple[Codec, Codec]:
        first, second = self._fields(0, one), self._fields(1, two)
        names = shared(one, first, second)
        if names is None:
            raise MappingError(f"{one} of ROS 1 and {two} of ROS 2 have different fields")
        # A rule may take a field of a field: in ROS 1's bytes, which have no gaps, the inner ones stand as if they were the outer's.
        opened = {name.partition(".")[0] for name in names.values() if "." in name}
        first = tuple(
            part
            for field in first
            for part in (
                [replace(f, name=f"{field.name}.{f.name}") for f in self._fields(0, field.kind)] if field.name in opened else [field]
            )
        )
        of_one = {field.name: field for field in first}
        codecs = {names[field.name]: self._field(of_one[names[field.name]], field) for field in second if field.name in names}
        return (
            Struct([(f.name, codecs[f.name][0] if f.name in codecs else self._alone(0, f)) for f in first], 0),
            Struct(
                [(names[f.name], codecs[names[f.name]][1]) if f.name in names else (" " + f.name, self._alone(1, f)) for f in second], 1
            ),
        )

    def _field(self, one: Field, two: Field) -> tuple[Codec, Codec]:
        if (one.many is None) != (two.many is None):
            raise MappingError(f"{one.name}: a list on one side alone")
        if "/" in one.kind and "/" in two.kind:
            first, second = self._message(one.kind, two.kind)
            return _listed(0, one, first), _listed(1, two, second)
        if one.kind in SIZES and two.kind in SIZES:
            if _alike(one.kind) != _alike(two.kind):
                return _listed(0, one, Converted(1, one.kind)), _listed(1, two, Converted(SIZES[two.kind], two.kind))
        elif one.kind != two.kind:
            raise MappingError(f"{one.name}: {one.kind} in ROS 1, {two.kind} in ROS 2")
        return self._alone(0, one), self._alone(1, two)

    def _alone(self, side: int, field: Field) -> Codec:
        """A field of this side, whatever the other has."""
        if field.kind in SIZES or field.kind in TIMES:
            width = SIZES.get(field.kind, 4)
            element: Codec = Flat(width if side else 1, 8 if field.kind in TIMES else width)
        elif field.kind == "string":
            element = Text(4, b"\0", field.bound if field.many is None else None) if side else Text(1, b"", None)
        elif "/" in field.kind:
            element = Struct([(" " + inner.name, self._alone(side, inner)) for inner in self._fields(side, field.kind)], side)
        else:
            raise MappingError(f"{field.name} is a {field.kind}, which ROS 1 has not")
        return _listed(side, field, element)


def _listed(side: int, field: Field, element: Codec) -> Codec:
    return element if field.many is None else Array(4 if side else 1, element, field.many, field.bound)


def _alike(kind: str) -> str:
    """One name for types of like bytes."""
    return {"byte": "uint8", "char": "uint8", "int8": "uint8"}.get(kind, kind)
