"""The plugin Plot of rqt."""

from __future__ import annotations

import argparse

import rosgraph.names
from rqt_gui_py.plugin import Plugin
from rqt_py_common.ini_helper import pack, unpack

from rqt_plot.data_plot import DataPlot
from rqt_plot.fields import FieldError, split_arguments
from rqt_plot.plot_widget import PlotWidget


class Plot(Plugin):
    """Numbers of topics over time."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("Plot")
        self._context = context
        self._args = self._parse_args(context.argv())
        self._widget = PlotWidget(initial_topics=self._args.topics, start_paused=self._args.start_paused)
        self._data_plot = DataPlot(self._widget)
        self._data_plot.set_autoscale(x=False, y=DataPlot.SCALE_EXTEND | DataPlot.SCALE_VISIBLE)
        self._data_plot.set_xlim([0, 10.0])
        self._widget.switch_data_plot_widget(self._data_plot)
        self._update_title()
        context.add_widget(self._widget)

    def _parse_args(self, argv):
        parser = argparse.ArgumentParser(prog="rqt_plot", add_help=False)
        Plot.add_arguments(parser)
        args = parser.parse_args(argv)
        try:
            args.topics = [rosgraph.names.script_resolve_name("rqt_plot", name) for name in split_arguments(args.topics)]
        except FieldError as error:
            parser.error(str(error))
        return args

    @staticmethod
    def add_arguments(parser) -> None:
        group = parser.add_argument_group("Options for rqt_plot plugin")
        group.add_argument("-P", "--pause", action="store_true", dest="start_paused", help="Start in paused state")
        group.add_argument("-e", "--empty", action="store_true", dest="start_empty", help="Start without restoring previous topics")
        group.add_argument("topics", nargs="*", default=[], help="Topics to plot, as /odom/twist/twist/linear/x:y")

    def _update_title(self) -> None:
        number = self._context.serial_number()
        self._widget.setWindowTitle(self._data_plot.getTitle() + (f" ({number})" if number > 1 else ""))

    def save_settings(self, plugin_settings, instance_settings) -> None:
        self._data_plot.save_settings(plugin_settings, instance_settings)
        instance_settings.set_value("autoscroll", self._widget.autoscroll_checkbox.isChecked())
        instance_settings.set_value("topics", pack(self._widget.topics()))

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        autoscroll = instance_settings.value("autoscroll", True) in [True, "true"]
        self._widget.autoscroll_checkbox.setChecked(autoscroll)
        self._data_plot.autoscroll(autoscroll)
        if not self._widget.topics() and not self._args.start_empty:
            for topic in unpack(instance_settings.value("topics", [])) or []:
                self._widget.add_topic(topic)
        self._data_plot.restore_settings(plugin_settings, instance_settings)
        self._update_title()

    def trigger_configuration(self) -> None:
        self._data_plot.doSettingsDialog()
        self._update_title()

    def shutdown_plugin(self) -> None:
        self._widget.shutdown()
