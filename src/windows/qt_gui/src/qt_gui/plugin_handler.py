"""One running plugin: its instance, its docks and toolbars, its settings."""

from typing import Any

from python_qt_binding.QtCore import QEvent, QObject, QSize, Qt, Signal, qCritical, qWarning
from python_qt_binding.QtWidgets import QDockWidget, QToolBar

from qt_gui.application.reporting import describe
from qt_gui.dock_widget import DockWidget, DockWidgetContainer
from qt_gui.icon_loader import get_icon
from qt_gui.plugin_context import PluginContext


class PluginHandler(QObject):
    """Holds a plugin from its loading to its end. Whatever the plugin raises is reported, and goes no further."""

    label_updated = Signal(str, str)  # instance id, title of its dock
    close_signal = Signal(str)
    reload_signal = Signal(str)
    help_signal = Signal(str)
    _check_close_later = Signal()

    def __init__(self, window, descriptor, instance_id, argv=None):
        """:param window: the :class:`qt_gui.main_window.MainWindow` to show things in"""
        super().__init__(window)
        self._window = window
        self._options = window.options
        self._descriptor = descriptor
        self._instance_id = instance_id
        self._argv = list(argv or [])
        self._plugin: Any = None  # what the provider makes
        self._docks = {}  # widget -> dock
        self.wanted_size = QSize()  # that its widgets were given before they were docked
        self._toolbars = []
        self._check_close_later.connect(self._check_close, Qt.ConnectionType.QueuedConnection)

    def instance_id(self):
        return self._instance_id

    def argv(self):
        return list(self._argv)

    def plugin(self):
        """The instance, or None before and after its life."""
        return self._plugin

    def docks(self):
        return list(self._docks.values())

    def load(self, provider):
        """Create the instance.

        :raises Exception: whatever the plugin raises; its widgets are gone then.
        """
        try:
            self._plugin = provider.load(self._descriptor.plugin_id(), PluginContext(self))
        except BaseException:
            self._remove_everything()
            raise
        if hasattr(self._plugin, "installEventFilter"):
            self._plugin.installEventFilter(self)
        if self._has_configuration():
            for dock in self._docks.values():
                dock.titleBarWidget().show_button("configuration_button")

    def unload(self, provider):
        """Shut the plugin down, take its widgets away, forget it."""
        if hasattr(self._plugin, "removeEventFilter"):
            self._plugin.removeEventFilter(self)
        self._call("shutdown_plugin")
        self._remove_everything()
        try:
            provider.unload(self._plugin)
        except Exception as error:
            self._report("cannot be unloaded", error)
        if hasattr(self._plugin, "deleteLater"):
            self._plugin.deleteLater()
        self._plugin = None

    def save_settings(self, plugin_settings, instance_settings):
        """Store what the plugin and its docks want to keep.

        :param plugin_settings: shared by all instances of the plugin, in every perspective
        :param instance_settings: of this instance in this perspective
        """
        self._call("save_settings", plugin_settings.get_settings("plugin"), instance_settings.get_settings("plugin"))
        for dock in self._docks.values():
            dock.save_settings(self._dock_settings(dock, instance_settings))

    def restore_settings(self, plugin_settings, instance_settings):
        """Give the plugin and its docks what :meth:`save_settings` stored in ``plugin_settings`` and ``instance_settings``."""
        self._call("restore_settings", plugin_settings.get_settings("plugin"), instance_settings.get_settings("plugin"))
        for dock in list(self._docks.values()):
            dock.restore_settings(self._dock_settings(dock, instance_settings))

    def _dock_settings(self, dock, settings):
        return settings.get_settings("dock_widget" + dock.objectName().replace(self._instance_id.tidy_str(), "", 1))

    def _call(self, method, *arguments):
        if hasattr(self._plugin, method):
            try:
                getattr(self._plugin, method)(*arguments)
            except Exception as error:  # a third party's code may raise anything; the window lives on
                self._report(f"fails in {method}()", error)

    def _report(self, what, error):
        qCritical(f"plugin '{self._instance_id}' {what}: {describe(error)}")

    def _has_configuration(self):
        if hasattr(self._plugin, "has_configuration"):
            return bool(self._plugin.has_configuration())
        return hasattr(self._plugin, "trigger_configuration")

    # what the context offers

    def add_widget(self, widget):
        if widget in self._docks:
            qWarning(f"plugin '{self._instance_id}' adds its widget '{widget.objectName()}' twice")
            return
        if widget.testAttribute(Qt.WidgetAttribute.WA_Resized):
            self.wanted_size = self.wanted_size.expandedTo(widget.size())
        dock = DockWidget(self._window.containers, hide_title=self._options.hide_title)
        self._prepare(dock)
        title_bar = dock.titleBarWidget()
        title_bar.connect_button("help_button", lambda: self.help_signal.emit(str(self._instance_id)))
        title_bar.connect_button("reload_button", self.reload_plugin)
        title_bar.connect_button("configuration_button", lambda: self._call("trigger_configuration"))
        title_bar.show_button("configuration_button", self._plugin is not None and self._has_configuration())
        dock.setObjectName(f"{self._instance_id.tidy_str()}__{widget.objectName()}")
        if self._window.findChild(QDockWidget, dock.objectName()) is not None:
            qWarning(
                f"plugin '{self._instance_id}' adds two widgets named '{widget.objectName()}'; their places in the window "
                "can only be kept when their object names differ"
            )
        dock.setWidget(widget)
        self._docks[widget] = dock
        self._window.addDockWidget(Qt.DockWidgetArea.BottomDockWidgetArea, dock)
        widget.windowTitleChanged.connect(dock.setWindowTitle)
        widget.windowIconChanged.connect(dock.setWindowIcon)
        dock.setWindowTitle(widget.windowTitle())
        if not widget.windowIcon().isNull():
            dock.setWindowIcon(widget.windowIcon())
        if widget.isHidden():
            widget.show()

    def _prepare(self, dock):
        """Features, icon and signals that every dock of this plugin has."""
        feature = QDockWidget.DockWidgetFeature
        features = feature.DockWidgetClosable | feature.DockWidgetMovable | feature.DockWidgetFloatable
        if self._options.lock_perspective or self._options.standalone_plugin:
            features = features & ~feature.DockWidgetClosable
        if self._options.freeze_layout:
            features = features & ~(feature.DockWidgetMovable | feature.DockWidgetFloatable)
        dock.setFeatures(features)
        action = self._descriptor.action_attributes()
        if action.get("icon"):
            dock.setWindowIcon(get_icon(action["icon"], action.get("icontype"), self._descriptor.attributes().get("plugin_path")))
        dock.windowTitleChanged.connect(lambda title: self.label_updated.emit(str(self._instance_id), title))
        dock.closed.connect(self._on_dock_closed)
        dock.installEventFilter(self)

    def remove_widget(self, widget):
        dock = self._docks.pop(widget, None)
        if dock is None:
            return
        dock.removeEventFilter(self)
        self._window.minimized.remove_dock(dock)
        if dock.main_window() is not None:
            dock.main_window().removeDockWidget(dock)
        widget.windowTitleChanged.disconnect(dock.setWindowTitle)
        widget.windowIconChanged.disconnect(dock.setWindowIcon)
        widget.setParent(None)
        dock.setParent(None)
        dock.deleteLater()
        self._check_close_later.emit()  # later, as the plugin may add another one right away

    def add_toolbar(self, toolbar):
        if toolbar in self._toolbars:
            qWarning(f"plugin '{self._instance_id}' adds its toolbar '{toolbar.objectName()}' twice")
            return
        prefix = self._instance_id.tidy_str() + "__"
        if not toolbar.objectName().startswith(prefix):
            toolbar.setObjectName(prefix + toolbar.objectName())
        if self._window.findChild(QToolBar, toolbar.objectName()) is not None:
            qWarning(
                f"plugin '{self._instance_id}' adds two toolbars named '{toolbar.objectName()[len(prefix) :]}'; their object "
                "names must differ"
            )
        if self._options.freeze_layout:
            toolbar.setMovable(False)
        self._toolbars.append(toolbar)
        self._window.addToolBar(Qt.ToolBarArea.TopToolBarArea, toolbar)
        toolbar.show()

    def remove_toolbar(self, toolbar):
        if toolbar in self._toolbars:
            self._toolbars.remove(toolbar)
            self._window.removeToolBar(toolbar)
            toolbar.setParent(None)
            self._check_close_later.emit()

    def close_plugin(self):
        """Soon; not when it is alone in its window."""
        if not self._options.standalone_plugin:
            self.close_signal.emit(str(self._instance_id))

    def reload_plugin(self):
        self.reload_signal.emit(str(self._instance_id))

    # the end of things

    def _on_dock_closed(self, dock):
        widget = next((w for w, d in self._docks.items() if d is dock), None)
        if widget is None:
            return
        if len(self._docks) + len(self._toolbars) == 1:
            self.close_plugin()  # settings are saved while its last dock is still there
            return
        self.remove_widget(widget)
        if widget is not self._plugin:
            widget.deleteLater()

    def _check_close(self):
        if self._plugin is not None and not self._docks and not self._toolbars:
            self.close_plugin()

    def _remove_everything(self):
        for widget in list(self._docks):
            self.remove_widget(widget)
            if widget is not self._plugin:
                widget.deleteLater()
        for toolbar in list(self._toolbars):
            self.remove_toolbar(toolbar)
            toolbar.deleteLater()

    def eventFilter(self, watched, event):
        """A plugin that deletes itself is closed; a dock that is minimised or shown again is told to the window.

        :param watched: the plugin, or one of its docks
        :return: whether ``event`` goes no further
        """
        kind = event.type()
        if watched is self._plugin and kind == QEvent.Type.DeferredDelete:
            self.close_signal.emit(str(self._instance_id))  # a plugin that deletes itself wants to be closed
            return True
        if isinstance(watched, DockWidget):
            if kind == QEvent.Type.HideToParent:
                self._window.minimized.add_dock(watched)
            elif kind == QEvent.Type.ShowToParent:
                self._window.minimized.remove_dock(watched)
        return False


class ContainerHandler(PluginHandler):
    """A container, which is listed, numbered and stored as if it were a plugin."""

    def load(self, provider):
        self._plugin = DockWidgetContainer(self._window.containers, self._instance_id.serial_number)
        self._plugin.setObjectName(self._instance_id.tidy_str())
        number = self._instance_id.serial_number
        self._prepare(self._plugin)
        self._plugin.setWindowTitle(f"Container ({number})" if number > 1 else "Container")
        self._docks[self._plugin.inner] = self._plugin
        self._window.addDockWidget(Qt.DockWidgetArea.BottomDockWidgetArea, self._plugin)
        self._window.containers.add(self._plugin)

    def unload(self, provider):
        self._window.containers.remove(self._plugin)
        self._docks.clear()
        self._window.minimized.remove_dock(self._plugin)
        if self._plugin.main_window() is not None:
            self._plugin.main_window().removeDockWidget(self._plugin)
        self._plugin.setParent(None)
        self._plugin.deleteLater()
        self._plugin = None

    def _call(self, method, *arguments):
        pass
