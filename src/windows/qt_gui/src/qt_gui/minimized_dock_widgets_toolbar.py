"""The bar at the bottom with a button for each minimised dock."""

from python_qt_binding.QtWidgets import QToolBar

from qt_gui.application.compatibility import QAction


class MinimizedDockWidgetsToolbar(QToolBar):
    """Hidden while no dock is minimised; a click on an entry brings its dock back."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setObjectName("MinimizedDockWidgetsToolbar")
        self.setWindowTitle("Minimized docks")
        self._actions = {}
        self.hide()

    def add_dock(self, dock):
        if dock not in self._actions:
            action = QAction(dock.windowIcon(), dock.windowTitle(), self)
            action.triggered.connect(lambda checked=False: (dock.show(), dock.raise_()))
            self._actions[dock] = action
            self.addAction(action)
        self.show()

    def remove_dock(self, dock):
        action = self._actions.pop(dock, None)
        if action is not None:
            self.removeAction(action)
            action.deleteLater()
        self.setVisible(bool(self._actions))
