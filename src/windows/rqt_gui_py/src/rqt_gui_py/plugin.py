"""The base class of plugins that use rospy."""

from qt_gui.plugin import Plugin as Base


class Plugin(Base):
    """As :class:`qt_gui.plugin.Plugin`. The container has called ``rospy.init_node``; a plugin must not do it."""

    def __init__(self, context):
        super().__init__(context)

    def shutdown_plugin(self):
        """Unregister subscribers, publishers and services, and stop timers."""
