"""Files of perspectives: JSON whose values are Python literals. Nothing in them is ever evaluated as code.

``{"keys": {name: value}, "groups": {name: {...}}}``, a value being ``{"type": "repr", "repr": "'text'"}`` or
``{"type": "repr(QByteArray.hex)", "repr(QByteArray.hex)": "QtCore.QByteArray(b'00ff')", "pretty-print": "..."}``.
"""

from __future__ import annotations

import ast
import json
import os
import re
import tempfile
from typing import Any

from python_qt_binding.QtCore import QByteArray

from qt_gui.errors import PerspectiveError

_BYTES = "repr(QByteArray.hex)"
_BYTE_ARRAY = re.compile(r"^(?:\w+\.)*QByteArray\((.*)\)$", re.S)
_MOST = 16 << 20  # bytes; the file of a busy window has some ten thousand
_DEEPEST = 60  # groups in groups


def read(path: str) -> dict[str, Any]:
    """The perspective in a file, as ``{"keys": {name: value}, "groups": {...}}`` with values of Python and ``QByteArray``.

    :raises PerspectiveError: not to be read, not JSON, or a value that is no literal.
    """
    try:
        if os.path.getsize(path) > _MOST:
            raise PerspectiveError(f"perspective file {path} has over {_MOST >> 20} MiB, which no window needs")
        with open(path, encoding="utf-8") as file:
            data = json.load(file)
    except OSError as error:
        raise PerspectiveError(f"perspective file {path} cannot be read: {error.strerror}") from error
    except (ValueError, RecursionError) as error:
        raise PerspectiveError(f"perspective file {path} is not JSON: {error}") from error
    return _read_group(data, path, ())


def _read_group(data, path, place) -> dict[str, Any]:
    where = "/".join(place) or "the whole"
    if not isinstance(data, dict) or not isinstance(data.get("keys", {}), dict) or not isinstance(data.get("groups", {}), dict):
        raise PerspectiveError(f"perspective file {path}: {where} is not an object with keys and groups")
    if len(place) > _DEEPEST:
        raise PerspectiveError(f"perspective file {path}: over {_DEEPEST} groups within each other at {'/'.join(place[:3])}...")
    return {
        "keys": {name: _read_value(value, path, "/".join((*place, name))) for name, value in data.get("keys", {}).items()},
        "groups": {name: _read_group(group, path, (*place, name)) for name, group in data.get("groups", {}).items()},
    }


def _read_value(value, path, where):
    kind = value.get("type") if isinstance(value, dict) else None
    text = value.get(kind) if isinstance(kind, str) else None
    if kind not in ("repr", _BYTES) or not isinstance(text, str):
        raise PerspectiveError(f"perspective file {path}: the value of {where} has no type of repr or {_BYTES}")
    match = _BYTE_ARRAY.match(text.strip())
    try:
        literal = ast.literal_eval(match.group(1) or "b''" if match else text)
        if kind == _BYTES:
            return QByteArray.fromHex(QByteArray(literal.encode() if isinstance(literal, str) else bytes(literal)))
        return QByteArray(bytes(literal)) if match else literal
    except (ValueError, SyntaxError, TypeError, MemoryError, RecursionError) as error:
        raise PerspectiveError(f"perspective file {path}: the value of {where} is not a Python literal: {text[:60]!r}") from error


def write(path: str, data: dict[str, Any]) -> None:
    """Write ``data``, as :func:`read` returns it; a file that is at ``path`` is replaced only when all is written.

    :raises PerspectiveError: the file cannot be written, or a value has no literal form.
    """
    text = json.dumps(_to_write(data), indent=2, separators=(",", ": "))
    folder = os.path.dirname(os.path.abspath(path))
    try:
        handle, temporary = tempfile.mkstemp(dir=folder, prefix=".perspective")
        try:
            with os.fdopen(handle, "w", encoding="utf-8") as file:
                file.write(text)
            mask = os.umask(0)
            os.umask(mask)
            os.chmod(temporary, 0o666 & ~mask)
            os.replace(temporary, path)
        except BaseException:
            os.unlink(temporary)
            raise
    except OSError as error:
        raise PerspectiveError(f"perspective file {path} cannot be written: {error.strerror}") from error


def _to_write(group):
    return {
        "keys": {name: _value_to_write(name, value) for name, value in group["keys"].items()},
        "groups": {name: _to_write(inner) for name, inner in group["groups"].items()},
    }


def _value_to_write(name, value):
    if isinstance(value, QByteArray):
        data = bytes(value)
        shown = "".join(chr(byte) if 32 <= byte < 127 else " " for byte in data[1::2])
        return {_BYTES: f"QtCore.QByteArray({data.hex().encode()!r})", "type": _BYTES, "pretty-print": shown}
    text = repr(value)
    try:
        if ast.literal_eval(text) != value:
            raise ValueError
    except (ValueError, SyntaxError) as error:
        raise PerspectiveError(f"the setting {name} of a plugin is a {type(value).__name__}, which no perspective file can hold") from error
    return {"repr": text, "type": "repr"}
