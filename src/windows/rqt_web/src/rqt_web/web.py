"""The plugin."""

from python_qt_binding.QtCore import QUrl
from python_qt_binding.QtWidgets import QHBoxLayout, QLineEdit, QPushButton, QVBoxLayout, QWidget
from qt_gui.errors import PluginLoadError
from rqt_gui_py.plugin import Plugin

HOME = "http://ros.org"


def _make_view():
    """:raises PluginLoadError: the engine, which is large and no dependency, is not installed"""
    try:
        from python_qt_binding import QT_BINDING_VERSION

        if QT_BINDING_VERSION.startswith("6"):
            from PyQt6.QtWebEngineWidgets import QWebEngineView
        else:
            from PyQt5.QtWebEngineWidgets import QWebEngineView
        return QWebEngineView()
    except ImportError as error:
        package = "python3-pyqt6.qtwebengine" if "PyQt6" in str(error) else "python3-pyqt5.qtwebengine"
        raise PluginLoadError(f"rqt_web needs Qt's web engine: apt install {package} (then start rqt again)") from error


class Web(Plugin):
    """A page, and an address to type."""

    def __init__(self, context, make_view=_make_view):
        """:param make_view: makes a QWebEngineView or the like"""
        super().__init__(context)
        self.setObjectName("Web")
        self.view = make_view()
        self._widget = QWidget()
        self._widget.setObjectName("WebWidget")
        self._widget.setWindowTitle("Web" + (f" ({context.serial_number()})" if context.serial_number() > 1 else ""))
        self.address = QLineEdit()
        self.address.setObjectName("url_edit")
        self.address.returnPressed.connect(lambda: self.open(self.address.text()))
        bar, layout = QHBoxLayout(), QVBoxLayout(self._widget)
        for name, text, call in (("back_button", "<", "back"), ("forward_button", ">", "forward"), ("reload_button", "Reload", "reload")):
            button = QPushButton(text)
            button.setObjectName(name)
            button.clicked.connect(lambda checked=False, call=call: getattr(self.view, call)())
            bar.addWidget(button)
        bar.addWidget(self.address)
        layout.addLayout(bar)
        layout.addWidget(self.view)
        self.view.urlChanged.connect(lambda url: self.address.setText(url.toString()))
        context.add_widget(self._widget)

    def open(self, address: str) -> None:
        self.address.setText(address)
        self.view.setUrl(QUrl.fromUserInput(address))

    def save_settings(self, plugin_settings, instance_settings) -> None:
        instance_settings.set_value("url_current", self.address.text())

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        self.open(instance_settings.value("url_current", HOME) or HOME)
