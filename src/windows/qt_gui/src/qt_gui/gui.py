"""The whole of a window: plugins, perspectives, menus, wired together."""

from typing import Any

from python_qt_binding.QtCore import QObject, Qt
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import QApplication

from qt_gui.application.compatibility import QAction
from qt_gui.application.help_and_about import show_about, show_plugin_help
from qt_gui.composite_plugin_provider import CompositePluginProvider
from qt_gui.errors import UsageError
from qt_gui.main_window import MainWindow
from qt_gui.perspective_manager import HIDDEN, PerspectiveManager
from qt_gui.plugin_manager import PluginManager
from qt_gui.plugin_menu import PluginMenu


class Gui(QObject):
    """One window. ``plugins``, ``perspectives`` and ``window`` are its parts.

    :param providers: list of :class:`qt_gui.plugin_provider.PluginProvider`
    :param settings: the ``QSettings`` to keep everything in
    :param options: what :func:`qt_gui.application.options.parse` returns
    """

    def __init__(self, providers, settings, options):
        super().__init__()
        self._options = options
        self._settings = settings
        self.plugins = PluginManager(CompositePluginProvider(providers), options)
        self.perspectives = PerspectiveManager(settings)
        self.window: Any = None  # a MainWindow, while there is one

    def choose(self, name):
        """The id of the only plugin that ``name`` fits.

        :raises UsageError: none, or several.
        """
        found = self.plugins.find_plugins_by_name(name)
        if not found:
            raise UsageError(
                self.plugins.reason_against(name)
                or f"found no plugin matching '{name}'; rqt --list-plugins shows those of all packages on ROS_PACKAGE_PATH"
            )
        if len(found) > 1:
            raise UsageError(f"found multiple plugins matching '{name}'\n" + "\n".join(sorted(found.values())))
        return next(iter(found))

    def open(self):
        """Make the window and show it with the plugins that the options ask for.

        :raises UsageError, PerspectiveError: options that cannot be obeyed; there is no window then.
        """
        options = self._options
        alone = self.choose(options.standalone_plugin) if options.standalone_plugin else None
        window = self.window = MainWindow(options)
        if options.on_top:
            window.setWindowFlags(window.windowFlags() | Qt.WindowType.WindowStaysOnTopHint)
        window.close_requested.connect(self._end)
        self._fill_menus()
        self._connect()
        self.plugins.discover()
        if alone is None:
            window.resize(600, 450)
            window.move(100, 100)
            if options.perspective_file:
                name = options.perspective_file.replace("\\", "/").split("/")[-1]
                self.perspectives.import_perspective_from_file(options.perspective_file, HIDDEN + name)
            else:
                self.perspectives.set_perspective(options.perspective)
        else:
            self.perspectives.set_perspective(alone, hide_and_without_plugin_changes=True)
            new = not window.has_stored_geometry()
            if not self.plugins.load_plugin(alone, 0, options.plugin_args):
                raise UsageError("")  # its reason is on the terminal already
            handler = self.plugins.running()[0]
            if handler.docks() and handler.docks()[0].windowTitle():
                window.setWindowTitle(handler.docks()[0].windowTitle() + " - rqt")
            if new:
                window.adjustSize()
                screen = QApplication.primaryScreen().availableSize() * 0.9
                window.resize(window.size().expandedTo(handler.wanted_size).boundedTo(screen))
        window.show()

    def _fill_menus(self):
        if self._options.lock_perspective:
            self.plugins.set_window(self.window)
            return
        bar = self.window.menuBar()
        self.window.statusBar()
        files = bar.addMenu("&File")
        leave = QAction(QIcon.fromTheme("application-exit"), "&Quit", files)
        leave.setShortcut("Ctrl+Q")
        leave.triggered.connect(lambda checked=False: self.window.close())
        files.addAction(leave)
        self.plugins.set_window(self.window, PluginMenu(bar))
        self.perspectives.set_menu(bar.addMenu("P&erspectives"))
        helping = bar.addMenu("&Help")
        about = QAction(QIcon.fromTheme("help-about"), "&About", helping)
        about.triggered.connect(lambda checked=False: show_about(self.window))
        helping.addAction(about)

    def _connect(self):
        window, plugins, perspectives = self.window, self.plugins, self.perspectives
        perspectives.perspective_changed_signal.connect(window.perspective_changed)
        for receiver in (window, plugins):
            perspectives.save_settings_signal.connect(receiver.save_settings)
            perspectives.restore_settings_signal.connect(receiver.restore_settings)
        perspectives.restore_settings_without_plugin_changes_signal.connect(window.restore_settings)
        perspectives.restore_settings_without_plugin_changes_signal.connect(plugins.restore_settings_without_plugins)
        plugins.plugins_about_to_change_signal.connect(window.save_setup)
        plugins.plugins_changed_signal.connect(window.restore_places)
        plugins.plugin_help_signal.connect(lambda descriptor: show_plugin_help(window, descriptor))
        plugins.close_window_signal.connect(window.close, Qt.ConnectionType.QueuedConnection)

    def _end(self):
        """The window closes: settings are saved, plugins ended."""
        self.perspectives.save()
        self.plugins.shutdown()
        self._settings.sync()

    def dispose(self):
        """Delete the window and what is in it, now rather than in whatever order Python ends."""
        if self.window is not None:
            self.window.close()
            self.window.deleteLater()
            self.window = None
            QApplication.sendPostedEvents(None, 52)  # QEvent.DeferredDelete
