"""Descriptions as JSON, for another process: exact, without the code that pickle would run.

A record is an object with its class under ``_`` and only the fields that differ from their defaults; XML elements keep
their text. Where something was written (:class:`~ode_sim.description.model.Source`) is left out.
"""

from __future__ import annotations

import json
import xml.etree.ElementTree as ET
from dataclasses import MISSING, fields, is_dataclass
from typing import Any

from ode_sim.description import model
from ode_sim.math3 import Pose

_CLASS = "_"
_XML = "xml"
_RECORDS: dict[str, type] = {
    cls.__name__: cls
    for cls in vars(model).values()
    if isinstance(cls, type) and is_dataclass(cls) and cls not in (model.Source, model.Problem)
}
_RECORDS["Pose"] = Pose


def register(cls: type) -> type:
    """Let a frozen dataclass that holds descriptions travel with them; a decorator."""
    _RECORDS[cls.__name__] = cls
    return cls


def dumps(record: Any) -> str:
    """JSON text of a record, or of tuples and dictionaries of records.

    :raises TypeError: something else is in it
    """
    return json.dumps(_plain(record), separators=(",", ":"))


def loads(text: str) -> Any:
    """What :func:`dumps` was given; lists have become tuples.

    :raises ValueError: no such text
    """
    try:
        return _record(json.loads(text))
    except (KeyError, TypeError, ET.ParseError, RecursionError) as error:
        raise ValueError(f"this is no description: {type(error).__name__}: {error}") from error


def _plain(value: Any) -> Any:
    if value is None or isinstance(value, (str, bool, int, float)):
        return value
    if isinstance(value, (tuple, list)):
        return [_plain(item) for item in value]
    if isinstance(value, dict):
        return {_CLASS: "dict", "items": [[key, _plain(item)] for key, item in value.items()]}
    if isinstance(value, ET.Element):
        return {_CLASS: _XML, "text": ET.tostring(value, "unicode")}
    if _RECORDS.get(type(value).__name__) is not type(value):
        raise TypeError(f"a {type(value).__name__} is no part of a description")
    plain = {_CLASS: type(value).__name__}
    for name, default in _defaults(type(value)):
        item = getattr(value, name)
        if item is not default and (default is MISSING or isinstance(item, ET.Element) or item != default):
            plain[name] = _plain(item)
    return plain


def _record(plain: Any) -> Any:
    if isinstance(plain, list):
        return tuple(_record(item) for item in plain)
    if not isinstance(plain, dict):
        return plain
    kind = plain[_CLASS]
    if kind == _XML:
        return ET.fromstring(plain["text"])
    if kind == "dict":
        return {key: _record(item) for key, item in plain["items"]}
    return _RECORDS[kind](**{name: _record(item) for name, item in plain.items() if name != _CLASS})


_default_cache: dict[type, tuple] = {}


def _defaults(cls: type) -> tuple:
    """((field, its default or MISSING), ...) without ``source``."""
    if cls not in _default_cache:
        _default_cache[cls] = tuple(
            (f.name, f.default_factory() if f.default_factory is not MISSING else f.default) for f in fields(cls) if f.name != "source"
        )
    return _default_cache[cls]
