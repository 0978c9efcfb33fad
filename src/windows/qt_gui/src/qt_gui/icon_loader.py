"""Icons by theme name or file, and a theme for systems that have none."""

import os

from python_qt_binding.QtCore import qWarning
from python_qt_binding.QtGui import QIcon


def get_icon(name, type_=None, base_path=None):
    """The icon of a menu entry.

    :param name: of a theme's icon, or a file
    :param type_: "file" or "theme" (also when None)
    :param base_path: folder that a relative file is in
    """
    if type_ == "file":
        path = name if base_path is None else os.path.join(base_path, name)
        icon = QIcon(path)
        if icon.isNull() or not icon.availableSizes() and not path.endswith(".svg"):
            qWarning(f"icon {path} is missing or cannot be read")
        return icon
    return QIcon.fromTheme(name) if name else QIcon()


def choose_theme():
    """Use Tango when the desktop names no theme with icons for documents, as on a bare window manager."""
    QIcon.setFallbackThemeName("Tango")
    if any(QIcon.fromTheme(name).isNull() for name in ("document-save", "document-open", "edit-cut", "view-refresh")):
        QIcon.setThemeName("Tango")
