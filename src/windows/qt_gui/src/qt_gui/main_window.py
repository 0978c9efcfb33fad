"""The window: its geometry and the places of docks and toolbars, stored per perspective."""

from python_qt_binding.QtCore import QByteArray, Qt, Signal
from python_qt_binding.QtGui import QPainter
from python_qt_binding.QtWidgets import QDockWidget, QLabel, QMainWindow, QToolBar

from qt_gui.dock_widget import Containers
from qt_gui.minimized_dock_widgets_toolbar import MinimizedDockWidgetsToolbar


class MainWindow(QMainWindow):
    """Holds the docks of all plugins. Closing it goes through ``close_requested``, so that plugins are ended in order."""

    close_requested = Signal()

    def __init__(self, options):
        super().__init__()
        self.setObjectName("MainWindow")
        self.setDockNestingEnabled(True)
        self.options = options
        self.containers = Containers(self)
        self.minimized = MinimizedDockWidgetsToolbar(self)
        self.addToolBar(Qt.ToolBarArea.BottomToolBarArea, self.minimized)
        self._settings = None
        self._notice = None
        self._may_close = False

    def closeEvent(self, event):
        if not self._may_close:
            self._may_close = True
            self.close_requested.emit()
        event.accept()

    def show_notice(self, text):
        """A line at the bottom of the window until it is called with ""."""
        if self._notice is None:
            if not text:
                return
            self._notice = QLabel()
            self._notice.setObjectName("notice")
            self._notice.setWordWrap(True)
            self.statusBar().addWidget(self._notice, 1)
        self._notice.setText(text)
        self._notice.setVisible(bool(text))
        self.statusBar().setVisible(bool(text) or not self.options.lock_perspective)

    def empty_text(self):
        """What the window says while nothing is open in it."""
        if self.options.lock_perspective or any(dock.isVisible() for dock in self.findChildren(QDockWidget)):
            return ""
        return "Nothing is open here.\nThe menu Plugins opens a window of its own; the menu Perspectives has sets of them."

    def paintEvent(self, event):
        super().paintEvent(event)
        text = self.empty_text()
        if text:
            QPainter(self).drawText(self.rect(), int(Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap), text)

    def perspective_changed(self, name):
        self.setWindowTitle(f"{name} - rqt")

    def save_settings(self, _global_settings, perspective_settings):
        self._settings = perspective_settings.get_settings("mainwindow")
        self.save_setup()

    def restore_settings(self, _global_settings, perspective_settings):
        """Take the geometry at once; the places of docks come with :meth:`restore_places`, when all docks are there."""
        self._settings = perspective_settings.get_settings("mainwindow")
        geometry = self._settings.value("geometry")
        if isinstance(geometry, QByteArray):
            self.restoreGeometry(geometry)

    def has_stored_geometry(self):
        return self._settings is not None and isinstance(self._settings.value("geometry"), QByteArray)

    def save_setup(self):
        if self._settings is None:
            return
        self._settings.set_value("geometry", self.saveGeometry())
        self._settings.set_value("state", self.saveState())
        areas = self._settings.get_settings("toolbar_areas")
        for toolbar in self.findChildren(QToolBar, options=Qt.FindChildOption.FindDirectChildrenOnly):
            area = self.toolBarArea(toolbar)
            if toolbar.objectName() and area != Qt.ToolBarArea.NoToolBarArea:
                areas.set_value(toolbar.objectName(), getattr(area, "value", None) or int(area))

    def restore_places(self):
        """Put docks and toolbars where the perspective has them."""
        if self._settings is not None:
            state = self._settings.value("state")
            if isinstance(state, QByteArray):
                self.restoreState(state)
        self.containers.restore_states()
