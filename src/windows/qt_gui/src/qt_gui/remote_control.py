"""Commands to a running window over D-Bus: start a plugin, switch the perspective."""
import os
import shlex
import sys

from python_qt_binding.QtCore import QObject

try:
    from python_qt_binding import QtDBus
except ImportError:
    QtDBus = None

from qt_gui.errors import PerspectiveError, UsageError

_NAME = "org.ros.qt_gui"


class RemoteControl(QObject):
    """While it lives, the window can be commanded; without a session bus it does nothing."""

    def __init__(self, gui):
        super().__init__()
