"""The plugin."""

from qt_gui.errors import PluginLoadError
from rqt_gui_py.plugin import Plugin


class Shell(Plugin):
    """A login shell in a terminal."""

    def __init__(self, context):
        try:
            from .terminal_widget import TerminalWidget
        except ImportError as error:
            raise PluginLoadError(f"rqt_shell needs the Debian package python3-pyte ({error})") from error
        super().__init__(context)
        self.setObjectName("Shell")
        self._context = context
        self._widget = TerminalWidget()
        self._widget.setWindowTitle("Shell" + (f" ({context.serial_number()})" if context.serial_number() > 1 else ""))
        self._widget.ended.connect(context.close_plugin)
        context.add_widget(self._widget)

    @property
    def widget(self):
        return self._widget

    def shutdown_plugin(self):
        self._widget.end()
