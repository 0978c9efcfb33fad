"""What fields a message has, and the messages in it."""

from __future__ import annotations

import inspect
from typing import Any

from rosbridge_library.internal import ros_loader
from rosbridge_library.internal.message_conversion import FLOATS, INTEGERS, TIMES, split_type

from rosapi.msg import TypeDef

ATOMIC = {*INTEGERS, *FLOATS, "bool", "string"}


def of_message(name: str) -> list[TypeDef]:
    """The type ``name``, and below it all that its fields have; none for what is no message.

    :raises RosbridgeError: nothing here defines it
    """
    return _with_parts(name, set())


def of_class(kind: Any) -> list[TypeDef]:
    """As :func:`of_message`, for ``kind``, the request or response of a service."""
    own = _typedef(kind)
    return [own, *_parts(own, set())]


def _with_parts(name: str, seen: set[str]) -> list[TypeDef]:
    if name in seen:
        return []
    seen.add(name)
    own = _own(name)
    return [] if own is None else [own, *_parts(own, seen)]


def _parts(own: TypeDef, seen: set[str]) -> list[TypeDef]:
    return [part for name in own.fieldtypes for part in _with_parts(name, seen)]


def _own(name: str) -> TypeDef | None:
    if name in ATOMIC:
        return None
    if name in TIMES:
        return TypeDef(type=name, fieldnames=["secs", "nsecs"], fieldtypes=["int32", "int32"], fieldarraylen=[-1, -1], examples=["0", "0"])
    return _typedef(ros_loader.get_message_class(name))


def _typedef(kind: Any) -> TypeDef:
    instance = kind()
    fields = [(name, *split_type(rostype)) for name, rostype in zip(kind.__slots__, kind._slot_types)]
    constants = [
        (name, str(value))
        for name, value in inspect.getmembers(kind)
        if name not in kind.__slots__ and not name.startswith("_") and not inspect.isroutine(value)
    ]
    return TypeDef(
        type=f"{kind.__module__.partition('.')[0]}/{kind.__name__}",
        fieldnames=[name for name, _, _ in fields],
        fieldtypes=[base for _, base, _ in fields],
        fieldarraylen=[-1 if length is None else length for _, _, length in fields],
        examples=[
            "[]" if length is not None else str(getattr(instance, name)) if base in ATOMIC else "{}" for name, base, length in fields
        ],
        constnames=[name for name, _ in constants],
        constvalues=[value for _, value in constants],
    )
