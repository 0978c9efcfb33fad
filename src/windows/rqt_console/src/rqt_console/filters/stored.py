"""Rules in settings and perspectives, in upstream's form: a list of kinds, and a group of values for each rule."""

from __future__ import annotations

from typing import Any

from python_qt_binding.QtCore import QDateTime
from rqt_py_common.ini_helper import pack, unpack

from ..message import SEVERITIES
from .kinds import KINDS

_STAMP = "hh:mm:ss.zzz (yyyy-MM-dd)"
_LEVELS = {name: level for level, name in SEVERITIES.items()}


def store(settings, name: str, rules: list[list]) -> None:
    """Keep ``rules``, as ``RuleBox.state`` gives them, under ``<name>_filters`` and ``<name>_filter_<i>/...`` of ``settings``.

    :param name: ``exclude`` or ``highlight``
    """
    settings.set_value(f"{name}_filters", pack([kind for kind, _, _ in rules]))
    for index, (kind, enabled, state) in enumerate(rules):
        group = settings.get_settings(f"{name}_filter_{index}")
        group.set_value("enabled", enabled)
        if kind == "time":
            for key in ("start", "stop"):
                group.set_value(f"{key}_time", QDateTime.fromMSecsSinceEpoch(round(state[key] * 1000)).toString(_STAMP))
            group.set_value("stop_time_enabled", state["stop_enabled"])
        elif kind == "custom":
            _store_text(group, state["message"])
            for part in ("severity", "topic", "node"):
                group.set_value(f"{part}itemlist", _items(part, state[part]["selected"]))
        elif "text" in state:
            _store_text(group, state)
        else:
            group.set_value("itemlist", _items(kind, state["selected"]))


def load(settings, name: str, default: list[list]) -> list[list]:
    """The rules that :func:`store` or Noetic's console has kept in ``settings`` as ``name``; ``default`` where none were. Unknown
    kinds are left out.
    """
    if not settings.contains(f"{name}_filters"):
        return default
    rules = []
    for index, kind in enumerate(unpack(settings.value(f"{name}_filters"))):
        if kind in KINDS:
            group = settings.get_settings(f"{name}_filter_{index}")
            rules.append([kind, _true(group.value("enabled", True)), _state(kind, group)])
    return rules


def _state(kind: str, group) -> dict:
    if kind == "time":
        state: dict[str, Any] = {"stop_enabled": _true(group.value("stop_time_enabled", True))}
        for key in ("start", "stop"):
            time = QDateTime.fromString(str(group.value(f"{key}_time", "")), _STAMP)
            state[key] = time.toMSecsSinceEpoch() / 1000 if time.isValid() else 0.0
        return state
    if kind == "custom":
        parts = {part: _selected(part, group.value(f"{part}itemlist", "")) for part in ("severity", "topic", "node")}
        return {"message": _text(group), **parts}
    return _text(group) if kind in ("message", "location") else _selected(kind, group.value("itemlist", ""))


def _store_text(group, state: dict) -> None:
    group.set_value("text", state["text"])
    group.set_value("regex", state["regex"])


def _text(group) -> dict:
    return {"text": str(group.value("text", "") or ""), "regex": _true(group.value("regex", False))}


def _items(kind: str, values: list):
    """Severities are kept by name."""
    return pack([SEVERITIES.get(value, str(value)) if kind == "severity" else value for value in values])


def _selected(kind: str, stored) -> dict:
    texts = [str(text) for text in unpack(stored)]
    return {"selected": [_LEVELS[text] for text in texts if text in _LEVELS] if kind == "severity" else texts}


def _true(value) -> bool:
    return value in (True, "true")
