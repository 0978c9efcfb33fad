"""The plugin Multiplot of rqt."""

from __future__ import annotations

import argparse

from rqt_gui_py.plugin import Plugin
from rqt_plot.rosplot import TopicTypes

from rqt_multiplot.widget import MOST_HISTORY, MultiplotWidget


class MultiplotPlugin(Plugin):
    """A table of plots."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("MultiplotPlugin")
        self._number = context.serial_number()
        args = self._parse_args(context.argv())
        self._configured = bool(args.multiplot_config)
        self._run_all = args.multiplot_run_all
        self._types = TopicTypes()
        self._widget = MultiplotWidget(self._types)
        self._widget.title_changed.connect(self._set_title)
        self._set_title("Multiplot")
        context.add_widget(self._widget)
        if args.multiplot_config:
            self._widget.load(args.multiplot_config)
        if args.multiplot_bag:
            self._widget.load_bag(args.multiplot_bag)
        elif self._run_all:
            self._widget.view.run_all()

    def _parse_args(self, argv):
        parser = argparse.ArgumentParser(prog="rqt_multiplot", add_help=False)
        MultiplotPlugin.add_arguments(parser)
        return parser.parse_args(argv)

    @staticmethod
    def add_arguments(parser) -> None:
        group = parser.add_argument_group("Options for rqt_multiplot plugin")
        group.add_argument("-c", "--multiplot-config", default="", metavar="URL", help="Load an xml plot configuration")
        group.add_argument("-r", "--multiplot-run-all", action="store_true", help="Run all plots on startup")
        group.add_argument(
            "-b", "--multiplot-bag", default="", metavar="FILE", help="Show the messages of a bag in the plots of the configuration"
        )

    def _set_title(self, title: str) -> None:
        self._widget.setWindowTitle(title + (f" ({self._number})" if self._number > 1 else ""))

    def save_settings(self, plugin_settings, instance_settings) -> None:
        instance_settings.remove("history")
        instance_settings.set_value("history/max_length", MOST_HISTORY)
        for index, url in enumerate(self._widget.get_history()):
            instance_settings.set_value(f"history/config_{index}", url)

        # Nobody can be asked while a window closes, perhaps by Ctrl-C: changes come back with the next window.
        instance_settings.set_value("unsaved", self._widget.unsaved())
        instance_settings.set_value("unsaved_url", self._widget.url)

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        saved: list[str] = []
        while len(saved) < MOST_HISTORY and instance_settings.contains(f"history/config_{len(saved)}"):
            saved.append(str(instance_settings.value(f"history/config_{len(saved)}")))
        self._widget.set_history(self._widget.get_history() + saved)
        if instance_settings.value("unsaved", "") and not self._configured:
            self._widget.restore_unsaved(instance_settings.value("unsaved"), str(instance_settings.value("unsaved_url", "")))
            if self._run_all:
                self._widget.view.run_all()

    def shutdown_plugin(self) -> None:
        self._widget.view.close_all()
        self._types.close()
