"""The names that plug-ins import, which binding is chosen, and .ui files."""

import importlib.util
import os
import subprocess
import sys

import pytest

UI = """<ui version="4.0"><class>Form</class><widget class="QWidget" name="Form"><layout class="QVBoxLayout">
<item><widget class="QPushButton" name="go"><property name="text"><string>Go</string></property></widget></item></layout></widget></ui>"""


def python(code, **changed):
    """Last line that a new interpreter prints, or the last line of its error: the binding is chosen once in a process."""
    ended = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        timeout=60,
        env={**os.environ, "QT_QPA_PLATFORM": "offscreen", "QT_API": "", **changed},
    )
    return (ended.stdout or ended.stderr).strip().splitlines()[-1]


def test_names_that_plugins_import():
    assert (
        python(
            "from python_qt_binding import QT_BINDING, QT_BINDING_VERSION, QT_BINDING_MODULES, loadUi, QtGui, QtWidgets\n"
            "from python_qt_binding.QtCore import Qt, Signal, Slot, Property, pyqtSignal, qVersion\n"
            "from python_qt_binding.QtWidgets import QApplication\n"
            "from python_qt_binding.binding_helper import QT_BINDING_VERSION as again\n"
            "import python_qt_binding.QtSvg, QtCore\n"
            "print(QT_BINDING, qVersion()[0], Signal is pyqtSignal, again == QT_BINDING_VERSION, QtCore.Qt is Qt, "
            "QT_BINDING_MODULES['QtWidgets'] is QtWidgets)"
        )
        == "pyqt 5 True True True True"
    )


@pytest.mark.parametrize("wanted, chosen", [("", "5"), ("pyqt", "5"), ("pyqt6", "6"), ("PyQt6", "6"), ("pyqt5", "5")])
def test_qt_5_unless_qt_api_asks_for_6(tmp_path, wanted, chosen):
    for version in "56":  # stand-ins, for a machine may lack one
        package = tmp_path / f"PyQt{version}"
        package.mkdir()
        for name in ("__init__", "QtGui", "QtWidgets"):
            (package / f"{name}.py").write_text("class QDrag:\n exec = 1\nQGuiApplication = QApplication = QDialog = QMenu = QDrag")
        (package / "QtCore.py").write_text(
            f"PYQT_VERSION_STR = '{version}'\npyqtSignal = pyqtSlot = pyqtProperty = None\n"
            "class QThread:\n exec = 1\nQCoreApplication = QEventLoop = QThread"
        )
    path = f"{tmp_path}:{os.environ.get('PYTHONPATH', '')}"
    assert python("import python_qt_binding as b; print(b.QT_BINDING_VERSION)", QT_API=wanted, PYTHONPATH=path) == chosen
    assert python("import PyQt6.QtCore, python_qt_binding as b; print(b.QT_BINDING_VERSION)", PYTHONPATH=path) == "6"


@pytest.mark.skipif(not importlib.util.find_spec("PyQt6"), reason="no PyQt6")
def test_names_of_qt_5_are_there_on_qt_6():
    assert (
        python(
            "from python_qt_binding import QT_BINDING_VERSION\nfrom python_qt_binding.QtCore import Qt, QEventLoop\n"
            "from python_qt_binding.QtGui import QImage, QPalette\n"
            "from python_qt_binding.QtWidgets import QAction, QApplication, QDialog, QMessageBox, QSizePolicy\n"
            "print(QT_BINDING_VERSION[0], Qt.AlignLeft | Qt.AlignTop == Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop, "
            "QImage.Format_RGB32.name, QSizePolicy.Expanding is QSizePolicy.Policy.Expanding, QMessageBox.Yes.name, "
            "QPalette.Window is QPalette.ColorRole.Window, QDialog.exec_ is not None, QAction.__module__)",
            QT_API="pyqt6",
        )
        == "6 True Format_RGB32 True Yes True True PyQt6.QtGui"
    )


def test_an_unknown_binding_is_refused():
    assert python("import sys; sys.SELECT_QT_BINDING = 'gtk'\nimport python_qt_binding") == "ImportError: Qt binding 'gtk' is unknown"


def test_the_remedy_is_named_when_there_is_none():
    said = python("import sys\nfor name in ('PyQt5', 'PyQt6', 'PySide2', 'PySide6'): sys.modules[name] = None\nimport python_qt_binding")
    assert said.startswith("ImportError: Could not find Qt binding (looked for: PyQt5:") and "apt install python3-pyqt5" in said


@pytest.mark.parametrize("base", ["None", "QWidget()"])
def test_ui_files(tmp_path, base):
    (tmp_path / "form.ui").write_text(UI)
    assert (
        python(
            "from python_qt_binding import loadUi\nfrom python_qt_binding.QtWidgets import QApplication, QWidget\n"
            f"app = QApplication([]); base = {base}; made = loadUi({str(tmp_path / 'form.ui')!r}, base)\n"
            "print(made.go.text(), base is None or made is base)"
        )
        == "Go True"
    )
