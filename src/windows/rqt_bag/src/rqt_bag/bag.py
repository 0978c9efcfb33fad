"""The plugin Bag of rqt."""

from __future__ import annotations

import argparse
import os

from rqt_gui_py.plugin import Plugin

from rqt_bag.bag_widget import BagWidget


class Bag(Plugin):
    """Bag files on a time line: look, play, publish, record."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("Bag")
        args = self._parse_args(context.argv())
        self._widget = BagWidget(context, args.clock)
        number = context.serial_number()
        if number > 1:
            self._widget.setWindowTitle(f"Bag ({number})")
        context.add_widget(self._widget)
        for name in args.bagfiles:
            self._widget.load_bag(name)

    def _parse_args(self, argv):
        parser = argparse.ArgumentParser(prog="rqt_bag", add_help=False)
        Bag.add_arguments(parser)
        return parser.parse_args(argv)

    @staticmethod
    def add_arguments(parser) -> None:
        def existing(name: str) -> str:
            if not os.path.isfile(name):
                parser.error(f"Bag file {name} does not exist")
            return name

        group = parser.add_argument_group("Options for rqt_bag plugin")
        group.add_argument("--clock", action="store_true", help="publish the clock time")
        group.add_argument("bagfiles", type=existing, nargs="*", default=[], help="Bagfiles to load")

    def shutdown_plugin(self) -> None:
        self._widget.shutdown_all()
