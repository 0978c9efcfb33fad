"""
Messages as what JSON has, and back.

Arrays of uint8 and char are base64 texts (taken as lists of numbers, too), times and durations ``{"secs": , "nsecs": }``,
floats that are not finite null. In BSON, which has words for them, bytes and such floats stay what they are.
"""

from __future__ import annotations

import base64
import binascii
import functools
import math
from collections.abc import Callable
from typing import Any

import genpy
import rospy

from rosbridge_library.internal import ros_loader
from rosbridge_library.internal.exceptions import RosbridgeError

BINARY = ("uint8", "char")
FLOATS = ("float32", "float64")
TIMES = {"time": genpy.Time, "duration": genpy.Duration}
INTEGERS = {
    **{f"int{bits}": (-(1 << bits - 1), (1 << bits - 1) - 1) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": (0, (1 << bits) - 1) for bits in (8, 16, 32, 64)},
}
INTEGERS.update(byte=INTEGERS["int8"], char=INTEGERS["uint8"])  # least and greatest value
_SECONDS = {"time": {"secs": "uint32", "nsecs": "uint32"}, "duration": {"secs": "int32", "nsecs": "int32"}}
_PYTHON = {
    bool: "true or false",
    int: "a whole number",
    float: "a number",
    str: "a text",
    type(None): "null",
    list: "a list",
    tuple: "a list",
    dict: "an object",
    bytes: "bytes",
}


class InvalidMessageException(RosbridgeError):
    def __init__(self, inst: Any) -> None:
        super().__init__(f"a {type(inst).__name__} is no message")


class NonexistentFieldException(RosbridgeError):
    def __init__(self, basetype: str, fields: tuple[str, ...], known: tuple[str, ...] = ()) -> None:
        has = f"; there {'are' if len(known) > 1 else 'is'} {', '.join(known)}" if known else "; it has none"
        super().__init__(f"{basetype} has no field {'.'.join(fields)}{has}")


class FieldTypeMismatchException(RosbridgeError):
    def __init__(self, roottype: str, fields: tuple[str, ...], expected_type: str, found: Any) -> None:
        kind = _PYTHON.get(type(found), f"a {type(found).__name__}")
        value = f" ({found!r:.40})" if isinstance(found, (str, int, float)) else ""
        super().__init__(f"{'.'.join((roottype, *fields))} should be {expected_type}, not {kind}{value}")


class FieldValueException(RosbridgeError):
    """Of the right type, but more or less than the field holds."""


@functools.cache
def split_type(rostype: str) -> tuple[str, int | None]:
    """``rostype`` as base and length: ``float64[36]`` -> ("float64", 36), "float64[]" -> ("float64", 0), "float64" -> ("float64", None)"""
    base, bracket, length = rostype.partition("[")
    return base, int(length[:-1] or 0) if bracket else None


# ---------------------------------------------------------------------------------------------- from messages


def extract_values(inst: Any, bson: bool = False) -> dict[str, Any]:
    """
    :param inst: a message, or the request or response of a service
    :param bson: leave bytes and floats as they are
    :raises InvalidMessageException:
    """
    if not hasattr(inst, "_slot_types"):
        raise InvalidMessageException(inst)
    return {name: outward(getattr(inst, name)) for name, outward in _fields(type(inst), bson)}  # type: ignore[arg-type]


@functools.cache
def _fields(kind: Any, bson: bool) -> tuple[tuple[str, Callable[[Any], Any]], ...]:
    return tuple((name, _outward(rostype, bson)) for name, rostype in zip(kind.__slots__, kind._slot_types))


@functools.cache
def _outward(rostype: str, bson: bool) -> Callable[[Any], Any]:
    base, length = split_type(rostype)
    if length is not None and base in BINARY:
        return bytes if bson else lambda value: base64.standard_b64encode(bytes(value)).decode("ascii")
    if base in FLOATS and not bson:
        return finite if length is None else _finite_list
    if base in INTEGERS or base in ("bool", "string", *FLOATS):
        return list if length is not None else lambda value: value
    one: Callable[[Any], Any] = (
        (lambda value: {"secs": value.secs, "nsecs": value.nsecs}) if base in TIMES else (lambda value: extract_values(value, bson))
    )
    return one if length is None else lambda values: [one(value) for value in values]


def finite(value: Any) -> Any:
    """``value``; JSON has no infinity and no NaN: null."""
    return value if math.isfinite(value) else None


def _finite_list(values: Any) -> Any:
    return list(values) if all(map(math.isfinite, values)) else [finite(value) for value in values]


# ---------------------------------------------------------------------------------------------- into messages


def populate_instance(msg: dict[str, Any], inst: Any) -> Any:
    """
    Give ``inst`` the fields that ``msg`` has. A header without a stamp gets the present time.

    :return: ``inst``
    :raises RosbridgeError: a field that is not there, or a value that is none of its type
    """
    return _object(msg, inst._type, inst, inst._type, ())


def _inward(value: Any, rostype: str, inst: Any, root: str, path: tuple[str, ...]) -> Any:
    base, length = split_type(rostype)
    if length is None:
        return _one(value, base, inst, root, path)
    if base in BINARY:
        result: Any = _bytes(value, rostype, root, path)
    elif isinstance(value, (list, tuple)):
        result = [_one(each, base, None, root, path) for each in value]
    else:
        raise FieldTypeMismatchException(root, path, f"list ({rostype})", value)
    if length and len(result) != length:
        raise FieldValueException(f"{'.'.join((root, *path))} has {len(result)} elements, and a {rostype} {length}")
    return result


def _one(value: Any, base: str, inst: Any, root: str, path: tuple[str, ...]) -> Any:
    if base in TIMES:
        return _time(value, base, root, path)
    if base in INTEGERS:
        if type(value) is not int:
            raise FieldTypeMismatchException(root, path, base, value)
        least, most = INTEGERS[base]
        if not least <= value <= most:
            raise FieldValueException(f"{'.'.join((root, *path))} is {value}, and a {base} holds {least} to {most}")
        return value
    if base in FLOATS:
        if type(value) not in (int, float):
            raise FieldTypeMismatchException(root, path, base, value)
        return value
    if base in ("bool", "string"):
        if type(value) is not {"bool": bool, "string": str}[base]:
            raise FieldTypeMismatchException(root, path, base, value)
        return value
    return _object(value, base, ros_loader.get_message_instance(base) if inst is None else inst, root, path)


def _bytes(value: Any, rostype: str, root: str, path: tuple[str, ...]) -> bytes:
    try:
        if isinstance(value, str):
            return base64.b64decode(value.encode("ascii"), validate=True)
        if isinstance(value, (bytes, bytearray, list, tuple)):
            return bytes(value)
    except (binascii.Error, UnicodeEncodeError):
        raise FieldValueException(f"{'.'.join((root, *path))} is a text that is no base64") from None
    except (TypeError, ValueError):
        raise FieldValueException(f"{'.'.join((root, *path))} has elements that are no whole numbers of 0 to 255") from None
    raise FieldTypeMismatchException(root, path, f"base64 text or list ({rostype})", value)


def _time(value: Any, base: str, root: str, path: tuple[str, ...]) -> Any:
    if isinstance(value, genpy.TVal):
        return value
    if base == "time" and value == "now":
        return rospy.get_rostime()
    if not isinstance(value, dict):
        raise FieldTypeMismatchException(root, path, f"{base} (an object with secs and nsecs)", value)
    parts = _SECONDS[base]
    return TIMES[base](*(_one(value.get(name, 0), kind, None, root, (*path, name)) for name, kind in parts.items()))


def _object(msg: Any, rostype: str, inst: Any, root: str, path: tuple[str, ...]) -> Any:
    if not isinstance(msg, dict):
        raise FieldTypeMismatchException(root, path, f"{rostype} (an object)", msg)
    types = dict(zip(inst.__slots__, inst._slot_types))
    if rostype in ("Header", "std_msgs/Header", "roslib/Header") and "stamp" not in msg and rospy.core.is_initialized():
        inst.stamp = rospy.get_rostime()
    for name, value in msg.items():
        if name not in types:
            raise NonexistentFieldException(root, (*path, str(name)), tuple(inst.__slots__))
        setattr(inst, name, _inward(value, types[name], getattr(inst, name), root, (*path, name)))
    return inst
