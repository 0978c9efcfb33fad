"""The plugin Navigation Viewer of rqt."""

from rqt_gui_py.plugin import Plugin

from rqt_nav_view.nav_view import NavViewWidget


class NavViewPlugin(Plugin):
    """Shows a NavViewWidget."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("NavViewPlugin")
        self.widget = NavViewWidget()
        if context.serial_number() > 1:
            self.widget.setWindowTitle(f"{self.widget.windowTitle()} ({context.serial_number()})")
        context.add_widget(self.widget)

    def trigger_configuration(self) -> None:
        self.widget.ask_topics()

    def save_settings(self, plugin_settings, instance_settings) -> None:
        self.widget.save_settings(plugin_settings, instance_settings)

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        self.widget.restore_settings(plugin_settings, instance_settings)

    def shutdown_plugin(self) -> None:
        self.widget.shutdown()
