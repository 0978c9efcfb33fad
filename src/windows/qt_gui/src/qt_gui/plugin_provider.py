"""The interface of whatever finds, loads and unloads plugins; packages may export providers of their own."""

from python_qt_binding.QtCore import QObject


class PluginProvider(QObject):
    """Finds and loads plugins of one kind."""

    def __init__(self):
        super().__init__()
        self.setObjectName("PluginProvider")

    def discover(self, discovery_data):
        """A list of :class:`qt_gui.plugin_descriptor.PluginDescriptor`.

        :param discovery_data: ``Settings`` in which a provider may keep what it found, or None
        """
        raise NotImplementedError

    def load(self, plugin_id, plugin_context):
        """An instance of the plugin ``plugin_id``, given its context.

        :param plugin_context: what the plugin's constructor takes
        :raises PluginLoadError: it cannot be loaded; anything else that the plugin itself raises is passed on.
        """
        raise NotImplementedError

    def unload(self, plugin_instance):
        """Forget an instance that has been shut down."""

    def shutdown(self):
        """The window closes."""
