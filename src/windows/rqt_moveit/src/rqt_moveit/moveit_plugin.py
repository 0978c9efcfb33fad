"""The plugin MoveIt Monitor of rqt."""

from __future__ import annotations

from rqt_gui_py.plugin import Plugin

from rqt_moveit.moveit_widget import MoveitWidget


class MoveitPlugin(Plugin):
    """Nodes, parameters and topics of MoveIt, and whether they are there."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("Moveit")
        self._widget = MoveitWidget()
        number = context.serial_number()
        if number > 1:
            self._widget.setWindowTitle(f"{self._widget.windowTitle()} ({number})")
        context.add_widget(self._widget)

    def get_widget(self) -> MoveitWidget:
        return self._widget

    def save_settings(self, plugin_settings, instance_settings) -> None:
        self._widget.save_settings(instance_settings)

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        self._widget.restore_settings(instance_settings)

    def shutdown_plugin(self) -> None:
        self._widget.shutdown()
