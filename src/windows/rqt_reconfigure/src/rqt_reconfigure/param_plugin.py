"""The plugin."""

import argparse

from rqt_gui_py.plugin import Plugin

from .param_widget import ParamWidget


class ParamPlugin(Plugin):
    """All dynamic_reconfigure servers, and editors of those that are chosen."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("Dynamic Reconfigure")
        parser = argparse.ArgumentParser("rqt_reconfigure", add_help=False)
        self.add_arguments(parser)
        options, _ = parser.parse_known_args(context.argv())
        self._widget = ParamWidget(options.node_name)
        if context.serial_number() > 1:
            self._widget.setWindowTitle(f"{self._widget.windowTitle()} ({context.serial_number()})")
        context.add_widget(self._widget)

    @staticmethod
    def add_arguments(parser):
        group = parser.add_argument_group("Options for rqt_reconfigure plugin")
        group.add_argument("node_name", nargs="*", default=[], help="nodes to open")

    @property
    def widget(self) -> ParamWidget:
        return self._widget

    def shutdown_plugin(self):
        self._widget.close_all()

    def save_settings(self, plugin_settings, instance_settings):
        self._widget.save_settings(instance_settings)

    def restore_settings(self, plugin_settings, instance_settings):
        self._widget.restore_settings(instance_settings)
