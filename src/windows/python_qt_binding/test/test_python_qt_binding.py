"""The names that plug-ins import, which binding is chosen, and .ui files."""
import os
import subprocess
import sys

import pytest

UI = """<ui version="4.0"><class>Form</class><widget class="QWidget" name="Form"><layout class="QVBoxLayout">
<item><widget class="QPushButton" name="go"><property name="text"><string>Go</string></property></widget></item></layout></widget></ui>"""


def python(code):
    """Last line that a new interpreter prints, or the last line of its error: the binding is chosen once in a process."""
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60,
                           env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
    return (ended.stdout or ended.stderr).strip().splitlines()[-1]


def test_names_that_plugins_import():
    assert python("from python_qt_binding import QT_BINDING, QT_BINDING_VERSION, QT_BINDING_MODULES, loadUi, QtGui, QtWidgets\n"
                  "from python_qt_binding.QtCore import Qt, Signal, Slot, Property, pyqtSignal, qVersion\n"
                  "from python_qt_binding.QtWidgets import QApplication\n"
                  "from python_qt_binding.binding_helper import QT_BINDING_VERSION as again\n"
                  "import python_qt_binding.QtSvg, QtCore\n"
                  "print(QT_BINDING, qVersion()[0], Signal is pyqtSignal, again == QT_BINDING_VERSION, QtCore.Qt is Qt, "
                  "QT_BINDING_MODULES['QtWidgets'] is QtWidgets)") == "pyqt 5 True True True True"


def test_an_unknown_binding_is_refused():
    assert python("import sys; sys.SELECT_QT_BINDING = 'gtk'\nimport python_qt_binding") == "ImportError: Qt binding 'gtk' is unknown"


def test_the_remedy_is_named_when_there_is_none():
    said = python("import sys\nfor name in ('PyQt5', 'PyQt6', 'PySide2', 'PySide6'): sys.modules[name] = None\n"
                  "import python_qt_binding")
    assert said.startswith("ImportError: Could not find Qt binding (looked for: PyQt5:") and "apt install python3-pyqt5" in said


@pytest.mark.parametrize("base", ["None", "QWidget()"])
def test_ui_files(tmp_path, base):
    (tmp_path / "form.ui").write_text(UI)
    assert python("from python_qt_binding import loadUi\nfrom python_qt_binding.QtWidgets import QApplication, QWidget\n"
                  f"app = QApplication([]); base = {base}; made = loadUi({str(tmp_path / 'form.ui')!r}, base)\n"
                  "print(made.go.text(), base is None or made is base)") == "Go True"
