"""What a plugin is given to talk to the window that holds it."""

from python_qt_binding.QtCore import QObject


class PluginContext(QObject):
    """The window, as one running plugin sees it."""

    def __init__(self, handler):
        super().__init__(handler)
        self.setObjectName("PluginContext")
        self._handler = handler

    def serial_number(self):
        """1, 2, ... for the first, second, ... running instance of this plugin; 0 when it is alone in its window."""
        return self._handler.instance_id().serial_number

    def argv(self):
        """Command line arguments for the plugin, without a program name."""
        return self._handler.argv()

    def add_widget(self, widget):
        """Show ``widget`` in a dock of its own. Its ``objectName`` must be unique within the plugin, its ``windowTitle`` is
        the title of the dock. The window deletes it when the plugin ends."""
        self._handler.add_widget(widget)

    def remove_widget(self, widget):
        """Take ``widget`` out of its dock; from then on it is the caller's."""
        self._handler.remove_widget(widget)

    def add_toolbar(self, toolbar):
        """Put a ``QToolBar`` below the menu. The window deletes it when the plugin ends."""
        self._handler.add_toolbar(toolbar)

    def remove_toolbar(self, toolbar):
        """Take ``toolbar`` out of the window; from then on it is the caller's."""
        self._handler.remove_toolbar(toolbar)

    def close_plugin(self):
        """End this plugin, soon. One that is alone in its window stays."""
        self._handler.close_plugin()

    def reload_plugin(self):
        """End this plugin and start it again, soon, with its settings."""
        self._handler.reload_plugin()
