"""The base class of plugins. Deriving from it is optional: any class with some of its methods will do."""

from python_qt_binding.QtCore import QObject


class Plugin(QObject):
    """A plugin puts its widgets into the window through the ``context`` that its constructor is given.

    The window calls, in this order: the constructor, :meth:`restore_settings`, and at the end :meth:`save_settings` and
    :meth:`shutdown_plugin`. A plugin with a method ``trigger_configuration()`` gets a button in its title bar which calls it.
    """

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("Plugin")

    def shutdown_plugin(self):
        """Unregister subscribers and stop timers; the widgets are deleted by the window."""

    def save_settings(self, plugin_settings, instance_settings):
        """Store what shall be there next time.

        :param plugin_settings: :class:`qt_gui.settings.Settings` shared by all instances of this plugin
        :param instance_settings: those of this instance in the perspective in use
        """

    def restore_settings(self, plugin_settings, instance_settings):
        """Take back what :meth:`save_settings` stored; numbers and booleans may come back as strings.

        :param plugin_settings: shared by all instances of the plugin, in every perspective
        :param instance_settings: of this instance in this perspective
        """
