"""Docks: one for each widget of a plugin, and containers that hold docks themselves."""

from python_qt_binding.QtCore import QEvent, QPoint, QRect, Qt, Signal
from python_qt_binding.QtGui import QCursor, QIcon
from python_qt_binding.QtWidgets import QApplication, QDockWidget, QMainWindow

from qt_gui.dock_widget_title_bar import DockWidgetTitleBar


class DockWidget(QDockWidget):
    """A dock that may be moved between the window and its containers: by its title's menu, or dropped onto a container."""

    closed = Signal(object)  # the dock; the user wants it away

    def __init__(self, containers, hide_title=False):
        super().__init__()
        self._containers = containers
        self.setTitleBarWidget(DockWidgetTitleBar(self, hide_title))
        self.titleBarWidget().close_button.clicked.connect(lambda checked=False: self.closed.emit(self))
        self._dragged = False

    def closeEvent(self, event):
        """The window manager's button of a floating dock."""
        event.ignore()
        if self.titleBarWidget().closable():
            self.closed.emit(self)

    def main_window(self):
        """The window that the dock is in: the root's, or a container's."""
        parent = self.parent()
        return parent if isinstance(parent, QMainWindow) else None

    def container(self):
        """The container that it is in, or None."""
        return self._containers.owner_of(self.main_window()) if self._containers is not None else None

    def move_to(self, main_window, area=Qt.DockWidgetArea.BottomDockWidgetArea):
        """Move the dock into another main window, into that ``area`` of ``main_window``."""
        if main_window is self.main_window():
            return
        if self.main_window() is not None:
            self.main_window().removeDockWidget(self)
        main_window.addDockWidget(area, self)
        self.show()

    def other_places(self):
        """(title, function) of each place that this dock could be moved to."""
        return self._containers.places_for(self) if self._containers is not None else []

    def event(self, event):
        """A dock that is dragged and let go over a container goes into it; Qt offers it the places of its window only."""
        kind = event.type()
        if kind == QEvent.Type.MouseButtonPress:
            self._dragged = False
        elif kind == QEvent.Type.Move and QApplication.mouseButtons() & Qt.MouseButton.LeftButton:
            self._dragged = True
        handled = super().event(event)
        if kind == QEvent.Type.MouseButtonRelease and self._dragged and self._containers is not None:
            self._dragged = False
            target = self._containers.under(QCursor.pos(), self)
            if target is not None:
                self.move_to(target)
        return handled

    def save_settings(self, settings):
        container = self.container()
        settings.set_value("parent", container.serial_number() if container is not None else None)
        self.titleBarWidget().save_settings(settings)

    def restore_settings(self, settings):
        if self._containers is not None:
            self._containers.restore_parent(self, settings.value("parent", None))
        self.titleBarWidget().restore_settings(settings)


class DockWidgetContainer(DockWidget):
    """A dock which holds other docks."""

    def __init__(self, containers, serial_number):
        super().__init__(containers)
        self._serial_number = serial_number
        self._settings = None
        self.inner = QMainWindow()
        self.inner.setWindowFlags(Qt.WindowType.Widget)
        self.inner.setDockNestingEnabled(True)
        self.setWidget(self.inner)
        self.setWindowIcon(QIcon.fromTheme("folder"))

    def serial_number(self):
        return self._serial_number

    def setObjectName(self, name):
        super().setObjectName(name)
        self.inner.setObjectName(name + "__MainWindow")

    def save_settings(self, settings):
        own = settings.get_settings("mainwindow")
        own.set_value("geometry", self.inner.saveGeometry())
        own.set_value("state", self.inner.saveState())
        super().save_settings(settings)

    def restore_settings(self, settings):
        super().restore_settings(settings)
        self._settings = settings.get_settings("mainwindow")

    def restore_state(self):
        """Put the docks within where they were; called when all of them are there."""
        state = self._settings.value("state") if self._settings is not None else None
        if state is not None and hasattr(state, "size"):
            self.inner.restoreState(state)

    def contains(self, point: QPoint) -> bool:
        return QRect(self.inner.mapToGlobal(QPoint(0, 0)), self.inner.size()).contains(point)


class Containers:
    """The containers of one window, by serial number."""

    def __init__(self, root):
        self._root = root
        self._containers = {}

    def add(self, container):
        self._containers[container.serial_number()] = container

    def remove(self, container):
        """Forget a container; the docks in it go where it was."""
        for dock in self.docks_of(container):
            dock.move_to(container.main_window() or self._root)
        self._containers.pop(container.serial_number(), None)

    def docks_of(self, container):
        return [dock for dock in container.inner.findChildren(DockWidget) if dock.main_window() is container.inner]

    def owner_of(self, main_window):
        return next((c for c in self._containers.values() if c.inner is main_window), None)

    def under(self, point, dock):
        """The inner window of the container at a point on the screen which could take ``dock``, or None."""
        for container in self._containers.values():
            if container is not dock and container.isVisible() and container.contains(point) and not self._within(container, dock):
                return container.inner
        return None

    def places_for(self, dock):
        here = dock.container()
        places = [
            (f"Move into {c.windowTitle()}", lambda c=c: dock.move_to(c.inner))
            for c in self._containers.values()
            if c is not here and c is not dock and not self._within(c, dock)
        ]
        return places + ([("Move out of the container", lambda: dock.move_to(self._root))] if here is not None else [])

    def _within(self, container, dock):
        """Whether ``container`` is somewhere inside ``dock``, which then cannot go into it."""
        while container is not None:
            if container is dock:
                return True
            container = container.container()
        return False

    def restore_parent(self, dock, serial_number):
        """Move ``dock`` to where its settings say.

        :param serial_number: of the container, also as a string; None, or one that there is not: the window itself
        """
        try:
            target = self._containers.get(int(serial_number)) if serial_number not in (None, "", "None") else None
        except (TypeError, ValueError):
            target = None
        if target is not dock and dock.container() is not target:
            dock.move_to(self._root if target is None else target.inner)

    def restore_states(self):
        for container in self._containers.values():
            container.restore_state()
