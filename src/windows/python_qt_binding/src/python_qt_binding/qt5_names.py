"""Names that plugins written for PyQt5 use and PyQt6 has elsewhere: so that such plugins load in a window on Qt 6 too."""

from __future__ import annotations

import enum
from typing import Any

_MOVED = ("QAction", "QActionGroup", "QShortcut", "QUndoCommand", "QUndoGroup", "QUndoStack")  # to QtGui
_RUNNING = {
    "QtCore": ("QCoreApplication", "QEventLoop", "QThread"),
    "QtGui": ("QDrag", "QGuiApplication"),
    "QtWidgets": ("QApplication", "QDialog", "QMenu"),
}


def add(modules: dict[str, Any]) -> None:
    """``Qt.AlignLeft`` for ``Qt.AlignmentFlag.AlignLeft``, ``exec_``, ``QtWidgets.QAction``. A name that is there stays.

    :param modules: QtCore, QtGui and QtWidgets by name
    """
    for name in ("QtCore", "QtGui", "QtWidgets"):
        for kind in vars(modules[name]).values():
            for inner in list(vars(kind).values()) if isinstance(kind, type) else ():
                if isinstance(inner, type) and issubclass(inner, enum.Enum):
                    for word, member in inner.__members__.items():
                        if word not in vars(kind):
                            setattr(kind, word, member)
        for word in _RUNNING[name]:
            kind = getattr(modules[name], word)
            if not hasattr(kind, "exec_"):
                kind.exec_ = kind.exec
    for word in _MOVED:
        if hasattr(modules["QtGui"], word) and not hasattr(modules["QtWidgets"], word):
            setattr(modules["QtWidgets"], word, getattr(modules["QtGui"], word))
