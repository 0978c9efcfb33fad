"""The plugin."""

from rqt_gui_py.plugin import Plugin

from .launch_widget import LaunchWidget


class LaunchPlugin(Plugin):
    """A launch file whose nodes are started and stopped one by one."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("Launch")
        self._widget = LaunchWidget()
        if context.serial_number() > 1:
            self._widget.setWindowTitle(f"{self._widget.windowTitle()} ({context.serial_number()})")
        context.add_widget(self._widget)

    @property
    def widget(self) -> LaunchWidget:
        return self._widget

    def shutdown_plugin(self):
        self._widget.close_all()

    def save_settings(self, plugin_settings, instance_settings):
        for key, text in self._widget.choice().items():
            instance_settings.set_value(key, text)

    def restore_settings(self, plugin_settings, instance_settings):
        self._widget.choose({key: instance_settings.value(key, "") or "" for key in ("package", "file", "arguments")})
