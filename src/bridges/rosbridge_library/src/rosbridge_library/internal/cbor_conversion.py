"""Messages as what CBOR has: bytes as bytes, arrays of numbers by the tags of RFC 8746, little-endian."""

from __future__ import annotations

import functools
import struct
from collections.abc import Callable
from typing import Any

from cbor2 import CBORTag

from rosbridge_library.internal.message_conversion import BINARY, FLOATS, INTEGERS, TIMES, split_type

TAGGED = {
    "uint16": (69, "H"),
    "uint32": (70, "I"),
    "uint64": (71, "Q"),
    "byte": (72, "b"),
    "int8": (72, "b"),
    "int16": (77, "h"),
    "int32": (78, "i"),
    "int64": (79, "q"),
    "float32": (85, "f"),
    "float64": (86, "d"),
}  # tag, letter of struct


def extract_cbor_values(msg: Any) -> dict[str, Any]:
    """:param msg: a message, or the request or response of a service"""
    return {name: outward(getattr(msg, name)) for name, outward in _fields(type(msg))}  # type: ignore[arg-type]


@functools.cache
def _fields(kind: Any) -> tuple[tuple[str, Callable[[Any], Any]], ...]:
    return tuple((name, _outward(rostype)) for name, rostype in zip(kind.__slots__, kind._slot_types))


@functools.cache
def _outward(rostype: str) -> Callable[[Any], Any]:
    base, length = split_type(rostype)
    if length is not None and base in BINARY:
        return bytes
    if length is not None and base in TAGGED:
        tag, letter = TAGGED[base]
        return lambda values: CBORTag(tag, struct.pack(f"<{len(values)}{letter}", *values))
    one = _one(base)
    return one if length is None else lambda values: [one(value) for value in values]


def _one(base: str) -> Callable[[Any], Any]:
    if base in INTEGERS:
        return int
    if base in FLOATS:
        return float
    if base in TIMES:
        return lambda value: {"secs": value.secs, "nsecs": value.nsecs}
    return {"bool": bool, "string": str}.get(base, extract_cbor_values)
