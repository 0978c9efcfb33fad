"""The plugin."""
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from python_qt_binding.QtCore import Signal
from rqt_gui_py.plugin import Plugin

from .robot_monitor import RobotMonitorWidget


class RobotMonitorPlugin(Plugin):
    """Shows /diagnostics_agg."""

    _received = Signal(object)

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("RobotMonitor")
        self.widget = RobotMonitorWidget()
        if context.serial_number() > 1:
            self.widget.setWindowTitle(f"{self.widget.windowTitle()} ({context.serial_number()})")
        context.add_widget(self.widget)
        self._received.connect(self.widget.take)
        self._subscriber = rospy.Subscriber("/diagnostics_agg", DiagnosticArray, self._received.emit, queue_size=10)

    def shutdown_plugin(self):
        self._subscriber.unregister()
        self.widget.stop()

    def save_settings(self, plugin_settings, instance_settings):
        instance_settings.set_value("splitter", self.widget.splitter.saveState())

    def restore_settings(self, plugin_settings, instance_settings):
        if instance_settings.contains("splitter"):
            self.widget.splitter.restoreState(instance_settings.value("splitter"))
