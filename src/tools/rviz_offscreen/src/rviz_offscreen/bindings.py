"""RViz's Python bindings and the Qt they stand on: 5 on Debian 12, 6 on Debian 13."""

from __future__ import annotations

import contextlib
import ctypes
import importlib.util
from collections.abc import Iterator
from typing import TYPE_CHECKING

from . import qt

if TYPE_CHECKING or qt.package() != "PyQt6":
    from PyQt5 import sip
    from PyQt5.QtCore import QPoint, QRect
    from PyQt5.QtGui import QImage, QPainter
    from PyQt5.QtWidgets import QApplication, QDockWidget, QWidget
    from rviz import bindings as rviz
else:
    from PyQt6 import sip
    from PyQt6.QtCore import QPoint, QRect
    from PyQt6.QtGui import QImage, QPainter
    from PyQt6.QtWidgets import QApplication, QDockWidget, QWidget

    @contextlib.contextmanager
    def _names_asked_for() -> Iterator[None]:
        """Debian 13's RViz asks for sip's base types by shorter names than its PyQt6 gives them, and fails to load."""
        library = importlib.util.find_spec("rviz.rviz").origin
        with open(library, "rb") as file:
            if b"\0sip.simplewrapper\0" not in file.read():
                yield
                return
        head = 3 * ctypes.sizeof(ctypes.c_ssize_t)  # of a type object: reference count, type, size; then comes its name
        places = [
            (ctypes.c_void_p.from_address(id(kind) + head), ctypes.create_string_buffer(b"sip." + kind.__name__.encode()))
            for kind in (sip.simplewrapper, sip.wrapper, sip.wrappertype)
        ]
        before = [place.value for place, _ in places]
        for place, name in places:
            place.value = ctypes.addressof(name)
        yield
        for (place, _), name in zip(places, before):
            place.value = name

    with _names_asked_for():
        from rviz import rviz
    rviz = getattr(rviz, "rviz", rviz)

__all__ = [
    "QApplication",
    "QDockWidget",
    "QImage",
    "QPainter",
    "QPoint",
    "QRect",
    "QWidget",
    "disable_anti_aliasing",
    "loaded_library",
    "rviz",
    "sip",
]


def loaded_library(name: str) -> ctypes.CDLL:
    """A shared library that this process has loaded already, by its name without version."""
    with open("/proc/self/maps") as maps:
        path = next(line.split()[-1] for line in maps if f"/{name}" in line)
    return ctypes.CDLL(path)


def disable_anti_aliasing() -> None:
    """What rviz's --disable-anti-aliasing does, which the bindings do not have. To be called before the first window is made."""
    loaded_library("librviz.so")._ZN4rviz12RenderSystem19disableAntiAliasingEv()
