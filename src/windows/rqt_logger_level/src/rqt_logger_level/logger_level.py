"""The plugin."""

from rqt_gui_py.plugin import Plugin

from .logger_level_widget import LoggerLevelWidget


class LoggerLevel(Plugin):
    """Nodes, their loggers, the level of each."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("LoggerLevel")
        self._widget = LoggerLevelWidget()
        if context.serial_number() > 1:
            self._widget.setWindowTitle(f"{self._widget.windowTitle()} ({context.serial_number()})")
        context.add_widget(self._widget)
        self._widget.refresh_nodes()

    def shutdown_plugin(self):
        self._widget.close_calls()
