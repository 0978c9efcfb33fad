"""Plots in rqt_bag."""

from rqt_bag.plugins.plugin import Plugin

from rqt_bag_plugins.plot_view import PlotView


class PlotPlugin(Plugin):
    """Numbers of any message."""

    def get_view_class(self):
        return PlotView

    def get_renderer_class(self):
        return None

    def get_message_types(self):
        return ["*"]
