"""The plugin."""

from rqt_gui_py.plugin import Plugin

from .console_widget import PyConsoleWidget


class PyConsole(Plugin):
    """Python, in the window's own process: rospy is up, and ``window`` is the widget."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("PyConsole")
        self._widget = PyConsoleWidget({"context": context})
        self._widget.setWindowTitle("Python Console" + (f" ({context.serial_number()})" if context.serial_number() > 1 else ""))
        context.add_widget(self._widget)

    @property
    def widget(self) -> PyConsoleWidget:
        return self._widget
