"""loadUi for PySide, whose own loader knows no base instance."""

from __future__ import annotations

import importlib
from typing import Any


def load(package: str, uifile: str, baseinstance: Any, custom_widgets: dict[str, type]) -> Any:
    """The widget of ``uifile``; see :func:`python_qt_binding.loadUi` for ``baseinstance`` and ``custom_widgets``.

    :param package: ``PySide2`` or ``PySide6``
    """
    tools: Any = importlib.import_module(f"{package}.QtUiTools")
    core = importlib.import_module(f"{package}.QtCore")

    class Loader(tools.QUiLoader):
        """Gives the outermost widget's place to the base instance, and each named widget to it as an attribute."""

        def createWidget(self, class_name: str, parent: Any = None, name: str = "") -> Any:
            if baseinstance is not None and parent is None:
                return baseinstance
            made = custom_widgets[class_name](parent) if class_name in custom_widgets else super().createWidget(class_name, parent, name)
            if baseinstance is not None and name:
                setattr(baseinstance, name, made)
            return made

    widget = Loader(baseinstance).load(uifile)
    core.QMetaObject.connectSlotsByName(widget)
    return widget
