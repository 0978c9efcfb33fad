"""Which type of ROS 2 a type of ROS 1 is, by upstream's rules, and the fields that they share. Needs neither ROS."""

from __future__ import annotations

import re
from dataclasses import dataclass

#: Numbers, with their size in bytes: it is their alignment, too.
SIZES = {"bool": 1, "int8": 1, "uint8": 1, "byte": 1, "char": 1, "int16": 2, "uint16": 2, "int32": 4, "uint32": 4, "float32": 4}
SIZES.update({"int64": 8, "uint64": 8, "float64": 8})
FORMATS = dict(zip(SIZES, "?bBBBhHiIfqQd"))
_OF_ROS2 = {"boolean": "bool", "octet": "uint8", "float": "float32", "double": "float64"}
_SEQUENCE = re.compile(r"sequence<([^,]+)(?:, *(\d+))?>")
_FIXED = re.compile(r"(.+)\[(\d*)\]")
_TEXT = re.compile(r"string<(\d+)>")
#: Types that upstream maps by a rule of their own: ROS 1 -> ROS 2, with the fields of ROS 2 by those of ROS 1 where names differ.
RULES: dict[str, tuple[str, dict[str, str]]] = {
    "rosgraph_msgs/Log": ("rcl_interfaces/Log", {"stamp": "header.stamp"}),
    "std_msgs/Time": ("builtin_interfaces/Time", {}),
    "std_msgs/Duration": ("builtin_interfaces/Duration", {}),
}


@dataclass(frozen=True)
class Field:
    name: str
    kind: str  # a number, string, wstring, time, duration, or package/Name
    many: int | None = None  # None: one; 0: a sequence; n: an array of n
    bound: int | None = None  # the most elements, or letters of a string


#: Fields by type, package/Name.
Types = dict[str, tuple[Field, ...]]


def fields_of_ros1(names: list[str], kinds: list[str]) -> tuple[Field, ...]:
    """By ``names`` and ``kinds``, ``__slots__`` and ``_slot_types`` of a class."""
    found = []
    for name, kind in zip(names, kinds):
        array = _FIXED.fullmatch(kind)
        kind, many = (array[1], int(array[2] or 0)) if array else (kind, None)
        found.append(Field(name, "std_msgs/Header" if kind == "Header" else kind, many))
    return tuple(found)


def fields_of_ros2(types: dict[str, str]) -> tuple[Field, ...]:
    """By ``get_fields_and_field_types()`` of a class."""
    found = []
    for name, kind in types.items():
        many: int | None = None
        bound: int | None = None
        sequence, array = _SEQUENCE.fullmatch(kind), _FIXED.fullmatch(kind)
        if sequence:
            kind, many, bound = sequence[1], 0, int(sequence[2]) if sequence[2] else None
        elif array:
            kind, many = array[1], int(array[2])
        text = _TEXT.fullmatch(kind)
        if text:
            kind, bound = "string", bound if many is not None else int(text[1])
        kind = {"builtin_interfaces/Time": "time", "builtin_interfaces/Duration": "duration"}.get(kind, _OF_ROS2.get(kind, kind))
        found.append(Field(name, kind, many, bound))
    return tuple(found)


def packages_of_ros2(package: str) -> list[str]:
    """Where the counterparts of a package of ROS 1 may be: ``x_msgs`` is ``x_msgs`` or ``x_interfaces``."""
    return [package, package[: -len("_msgs")] + "_interfaces"] if package.endswith("_msgs") else [package]


def candidates(type_of_ros1: str) -> list[str]:
    """Types of ROS 2 (package/Name) that may be its counterpart, the likeliest first."""
    if type_of_ros1 in RULES:
        return [RULES[type_of_ros1][0]]
    package, _, name = type_of_ros1.partition("/")
    return [f"{one}/{name}" for one in packages_of_ros2(package)]


def candidates_of_ros1(type_of_ros2: str) -> list[str]:
    """The other way."""
    ruled = [one for one, (two, _) in RULES.items() if two == type_of_ros2]
    package, _, name = type_of_ros2.partition("/")
    packages = [package[: -len("_interfaces")] + "_msgs", package] if package.endswith("_interfaces") else [package]
    return ruled or [f"{one}/{name}" for one in packages]


def shared(type_of_ros1: str, one: tuple[Field, ...], two: tuple[Field, ...]) -> dict[str, str] | None:
    """Names of ROS 1's fields by those of ROS 2; None where each side has a field that the other has not (upstream's rule).

    Names are compared in small letters, as ROS 2 has no others: ``CameraInfo``'s ``K`` is ``k``. Header's ``seq`` is left out.

    :param one, two: the fields of ``type_of_ros1`` and of its counterpart
    """
    if type_of_ros1 in RULES and RULES[type_of_ros1][1]:
        special = RULES[type_of_ros1][1]
        return {f.name: special.get(f.name, f.name) for f in two}
    by_name = {f.name.lower(): f.name for f in one}
    pairs = {f.name: by_name[f.name] for f in two if f.name in by_name}
    lonely_one = [f.name for f in one if f.name not in pairs.values() and not (type_of_ros1 == "std_msgs/Header" and f.name == "seq")]
    lonely_two = [f.name for f in two if f.name not in pairs]
    return None if lonely_one and lonely_two else pairs
