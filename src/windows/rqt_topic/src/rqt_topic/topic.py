"""The plugin."""

from rqt_gui_py.plugin import Plugin

from .topic_widget import TopicWidget


class Topic(Plugin):
    """All topics; those that are checked with bandwidth, rate and values."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("Topic")
        self._widget = TopicWidget(self)
        if context.serial_number() > 1:
            self._widget.setWindowTitle(f"{self._widget.windowTitle()} ({context.serial_number()})")
        context.add_widget(self._widget)
        self._widget.start()

    @property
    def widget(self) -> TopicWidget:
        return self._widget

    def shutdown_plugin(self):
        self._widget.shutdown_plugin()

    def save_settings(self, plugin_settings, instance_settings):
        instance_settings.set_value("tree_widget_header_state", self._widget.tree.header().saveState())

    def restore_settings(self, plugin_settings, instance_settings):
        if instance_settings.contains("tree_widget_header_state"):
            self._widget.tree.header().restoreState(instance_settings.value("tree_widget_header_state"))
