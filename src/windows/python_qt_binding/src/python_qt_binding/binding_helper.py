"""Finds a Python binding of Qt and evens out what they call differently."""

from __future__ import annotations

import importlib
import os
import sys
from collections.abc import Sequence
from types import ModuleType
from typing import Any

#: Packages of each binding, the best first. One process can work with one version of Qt only.
_PACKAGES = {"pyqt": ("PyQt5", "PyQt6"), "pyside": ("PySide2", "PySide6")}
_REQUIRED = ("QtCore", "QtGui", "QtWidgets")
_OPTIONAL = (
    "QtBluetooth",
    "QtDBus",
    "QtDesigner",
    "QtHelp",
    "QtLocation",
    "QtMultimedia",
    "QtMultimediaWidgets",
    "QtNetwork",
    "QtNetworkAuth",
    "QtNfc",
    "QtOpenGL",
    "QtOpenGLWidgets",
    "QtPositioning",
    "QtPrintSupport",
    "QtQml",
    "QtQuick",
    "QtQuickWidgets",
    "QtSensors",
    "QtSerialPort",
    "QtSql",
    "QtSvg",
    "QtSvgWidgets",
    "QtTest",
    "QtWebChannel",
    "QtWebEngine",
    "QtWebEngineCore",
    "QtWebEngineWidgets",
    "QtWebSockets",
    "QtX11Extras",
    "QtXml",
    "QtXmlPatterns",
)


def _packages(binding: str) -> list[str]:
    """One that the process has loaded already comes first, then the one that QT_API names."""
    wanted = os.environ.get("QT_API", "").lower()
    return sorted(_PACKAGES[binding], key=lambda package: (f"{package}.QtCore" not in sys.modules, package.lower() != wanted))


def _load(package: str) -> dict[str, ModuleType]:
    """:raises ImportError: one of the required modules is missing"""
    modules = {name: importlib.import_module(f"{package}.{name}") for name in _REQUIRED}
    for name in _OPTIONAL:
        try:
            modules[name] = importlib.import_module(f"{package}.{name}")
        except ImportError:
            pass
    return modules


def _select(wanted: str | None, order: Sequence[str] | None) -> tuple[str, str, dict[str, ModuleType]]:
    """(binding, its package, modules by name)

    :raises ImportError: an unknown name, or nothing of what was asked for is installed; says what was tried
    """
    order = list(order or _PACKAGES)
    if wanted and wanted not in order:
        raise ImportError(f"Qt binding '{wanted}' is unknown")
    tried = []
    for binding in [wanted] if wanted else order:
        for package in _packages(binding) if binding in _PACKAGES else ():
            try:
                return binding, package, _load(package)
            except ImportError as error:
                tried.append(f"{package}: {error}")
    raise ImportError(
        f"Could not find Qt binding (looked for: {', '.join(tried) or order}); "
        "sudo apt install python3-pyqt5 python3-pyqt5.qtsvg brings one"
    )


QT_BINDING, _package, QT_BINDING_MODULES = _select(getattr(sys, "SELECT_QT_BINDING", None), getattr(sys, "SELECT_QT_BINDING_ORDER", None))
_core: Any = QT_BINDING_MODULES["QtCore"]
QT_BINDING_VERSION: str = _core.PYQT_VERSION_STR if QT_BINDING == "pyqt" else importlib.import_module(_package).__version__
os.environ["QT_API"] = QT_BINDING if _package in ("PyQt5", "PySide2") else _package.lower()  # matplotlib reads it
for _one, _other in (("Signal", "pyqtSignal"), ("Slot", "pyqtSlot"), ("Property", "pyqtProperty")):
    setattr(_core, *(_one, getattr(_core, _other)) if QT_BINDING == "pyqt" else (_other, getattr(_core, _one)))
if _package == "PyQt6":
    importlib.import_module("python_qt_binding.qt5_names").add(QT_BINDING_MODULES)
for _name, _module in QT_BINDING_MODULES.items():
    sys.modules.setdefault(_name, _module)  # `import QtCore` works too, as with upstream


def loadUi(uifile: str, baseinstance: Any = None, custom_widgets: dict[str, type] | None = None) -> Any:
    """The widget that a .ui file of Qt Designer describes.

    :param uifile: path of the file
    :param baseinstance: a widget that takes the place of the file's outermost one; its children become attributes of it
    :param custom_widgets: class name -> class; only PySide needs it
    """
    if QT_BINDING == "pyqt":
        return importlib.import_module(f"{_package}.uic").loadUi(uifile, baseinstance=baseinstance)
    from python_qt_binding.pyside_loader import load

    return load(_package, uifile, baseinstance, custom_widgets or {})
