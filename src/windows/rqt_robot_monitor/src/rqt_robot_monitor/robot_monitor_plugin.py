"""The plugin."""

from rqt_gui_py.plugin import Plugin

from .robot_monitor import RobotMonitorWidget


class RobotMonitorPlugin(Plugin):
    """Shows /diagnostics_agg."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("RobotMonitor")
        self.widget = RobotMonitorWidget(context)
        if context.serial_number() > 1:
            self.widget.setWindowTitle(f"{self.widget.windowTitle()} ({context.serial_number()})")
        context.add_widget(self.widget)

    def shutdown_plugin(self):
        self.widget.shutdown()

    def save_settings(self, plugin_settings, instance_settings):
        self.widget.save_settings(plugin_settings, instance_settings)

    def restore_settings(self, plugin_settings, instance_settings):
        self.widget.restore_settings(plugin_settings, instance_settings)
