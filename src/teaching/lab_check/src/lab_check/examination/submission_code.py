"""Which code of the submission the simulator loads, told before its first instruction: code that runs in the simulator can change what it
says later, but not what it has said."""

from __future__ import annotations

import importlib.util
import os
import sys
from collections.abc import Callable
from typing import Any

_ENDINGS = (".py", ".pyc", ".so", ".egg", ".zip")
_MOST, _LONGEST = 100, 500  # files; bytes of a path, so that one is written as a whole or not at all


def tell(pipe: int, home: str) -> None:
    """From here on each file below ``home`` that this process opens as code, or loads as a plugin, goes through the pipe once."""
    os.set_inheritable(pipe, False)
    known: set[str] = set()

    def load(path: Any) -> None:
        whole = os.path.abspath(os.fsdecode(path))
        if whole.startswith(f"{home}/") and whole not in known and len(known) < _MOST:
            known.add(whole)
            try:
                os.write(pipe, os.fsencode(whole)[:_LONGEST] + b"\0")
            except OSError:
                pass

    def look(event: str, arguments: tuple) -> None:
        if event in ("open", "ctypes.dlopen") and isinstance(arguments[0], (str, bytes)) and _is_code(arguments[0]):
            load(arguments[0])

    sys.addaudithook(look)
    _watch_libraries(load)


def _is_code(path: str | bytes) -> bool:
    name = os.path.basename(os.fsdecode(path))
    return name.endswith(_ENDINGS) or ".so." in name


def _watch_libraries(load: Callable[[str], None]) -> None:
    from gazebo_ros import compiled

    resolve = compiled.resolve

    def told_first(library: str, *arguments: Any) -> Any:
        load(library)
        return resolve(library, *arguments)

    compiled.resolve = told_first  # type: ignore[assignment]


def told(pipe: int) -> list[str]:
    """What has come through the pipe, whose end is not blocking; of a compiled module of Python its source."""
    data = b""
    try:
        while more := os.read(pipe, 1 << 16):
            data += more
    except BlockingIOError:
        pass
    return sorted({_source(os.fsdecode(path)) for path in data.split(b"\0") if path})[:_MOST]


def _source(path: str) -> str:
    try:
        return importlib.util.source_from_cache(path) if path.endswith(".pyc") else path
    except ValueError:
        return path
