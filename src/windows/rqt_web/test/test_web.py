"""Addresses, with a view that shows nothing: the engine is no dependency."""

import sys

import pytest
from python_qt_binding.QtCore import QUrl, Signal
from python_qt_binding.QtWidgets import QWidget
from qt_gui.errors import PluginLoadError
from rqt_testing.in_process import FakeContext
from rqt_web.web import Web


class View(QWidget):
    urlChanged = Signal(QUrl)

    def setUrl(self, url):
        self.url = url.toString()
        self.urlChanged.emit(url)


class Settings(dict):
    set_value = dict.__setitem__
    value = dict.get


def test_address_is_completed_and_kept():
    context, settings = FakeContext(), Settings()
    web = Web(context, View)
    web.address.setText("localhost:8080/x")
    web.address.returnPressed.emit()
    assert web.view.url == "http://localhost:8080/x" == web.address.text()
    web.save_settings(None, settings)
    again = Web(context, View)
    again.restore_settings(None, settings)
    assert again.view.url == "http://localhost:8080/x"


def test_without_the_engine_one_line_names_the_package(monkeypatch):
    for name in ("PyQt5", "PyQt6"):
        monkeypatch.setitem(sys.modules, f"{name}.QtWebEngineWidgets", None)
    with pytest.raises(PluginLoadError, match=r"^rqt_web needs Qt's web engine: apt install python3-pyqt[56]\.qtwebengine"):
        Web(FakeContext())
