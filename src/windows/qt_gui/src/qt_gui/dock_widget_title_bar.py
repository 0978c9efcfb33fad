"""The title bar of a dock: icon, title, and the buttons D C R ? - O X."""

from python_qt_binding.QtCore import QEvent, QSize, Qt, QTimer
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import QDockWidget, QHBoxLayout, QLabel, QLineEdit, QMenu, QSizePolicy, QToolButton, QWidget

# object name, text without an icon, theme icon, tool tip
_BUTTONS = (
    ("dockable_button", "D", "", "Dock widget can be docked"),
    ("configuration_button", "C", "preferences-system", "Configure this plugin"),
    ("reload_button", "R", "view-refresh", "Reload this plugin"),
    ("help_button", "?", "help-browser", "Help about this plugin"),
    ("minimize_button", "-", "", "Minimize to the bar below"),
    ("float_button", "O", "", "Undock into a window of its own, or dock again"),
    ("close_button", "X", "", "Close"),
)


class DockWidgetTitleBar(QWidget):
    """Buttons are found by object name: ``close_button``, ``reload_button`` and so on."""

    def __init__(self, dock_widget, hide_title=False):
        super().__init__(dock_widget)
        self.setObjectName("DockWidgetTitleBar")
        self._dock = dock_widget
        self._hide_title = hide_title
        self._named = None  # the title that the user has given
        self._connected = set()
        layout = QHBoxLayout(self)
        layout.setContentsMargins(2, 2, 2, 2)
        layout.setSpacing(1)
        self.icon_label, self.title_label = QLabel(self), QLabel(self)
        self.icon_label.setObjectName("icon_label")
        self.title_label.setObjectName("title_label")
        self.title_label.setMinimumWidth(1)
        self.title_label.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Preferred)
        layout.addWidget(self.icon_label)
        layout.addWidget(self.title_label, 1)
        self.title_edit = QLineEdit(self)
        self.title_edit.setObjectName("title_edit")
        self.title_edit.hide()
        self.title_edit.editingFinished.connect(self._finish_rename)
        layout.addWidget(self.title_edit, 1)
        if hide_title:
            layout.addStretch(1)
        self._buttons = {}
        for name, text, icon, tip in _BUTTONS:
            button = QToolButton(self)
            button.setObjectName(name)
            button.setText(text)
            button.setToolTip(tip)
            button.setAutoRaise(True)
            button.setFixedSize(QSize(18, 18))
            if icon and not QIcon.fromTheme(icon).isNull():
                button.setIcon(QIcon.fromTheme(icon))
                button.setIconSize(QSize(14, 14))
            layout.addWidget(button)
            self._buttons[name] = button
            setattr(self, name, button)
        self.dockable_button.setCheckable(True)
        self.dockable_button.setChecked(True)
        self.dockable_button.toggled.connect(self._set_dockable)
        self.float_button.clicked.connect(lambda: self._dock.setFloating(not self._dock.isFloating()))
        self.minimize_button.clicked.connect(self._dock.hide)
        for name in ("configuration_button", "reload_button", "help_button"):
            self._buttons[name].hide()
        dock_widget.featuresChanged.connect(self._update_features)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.customContextMenuRequested.connect(self._show_menu)
        dock_widget.installEventFilter(self)
        self._update_features()
        self.update_title()

    def connect_button(self, name, callback):
        """Call ``callback()`` when the button ``name`` (``help_button``, say) is clicked, and show it."""
        self._buttons[name].clicked.connect(lambda checked=False: callback())
        self.show_button(name)

    def show_button(self, name, visible=True):
        """Show the button ``name``, or hide it when not ``visible``; the help button stays hidden while titles are."""
        if name != "help_button" or not self._hide_title:
            self._buttons[name].setVisible(visible)

    def closable(self):
        return bool(self._dock.features() & QDockWidget.DockWidgetFeature.DockWidgetClosable)

    def _update_features(self, _features=None):
        feature = QDockWidget.DockWidgetFeature
        features = self._dock.features()
        self.close_button.setVisible(bool(features & feature.DockWidgetClosable))
        movable = bool(features & feature.DockWidgetFloatable)
        for button in (self.dockable_button, self.float_button, self.minimize_button):
            button.setVisible(movable)

    def _set_dockable(self, dockable):
        areas = Qt.DockWidgetArea.AllDockWidgetAreas if dockable else Qt.DockWidgetArea.NoDockWidgetArea
        self._dock.setAllowedAreas(areas)

    def update_title(self):
        """Show the icon and the title of the dock."""
        self.icon_label.setVisible(not self._hide_title)
        self.title_label.setVisible(not self._hide_title)
        self.title_label.setText(self._dock.windowTitle())
        icon = self._dock.windowIcon()
        self.icon_label.setPixmap(icon.pixmap(16, 16)) if not icon.isNull() else self.icon_label.clear()

    def named_title(self):
        """What the user has renamed the dock to, or None."""
        return self._named

    def rename(self, title):
        self._named = title or None
        if title:
            self._dock.setWindowTitle(title)

    def eventFilter(self, watched, event):
        """Follow the title and icon of ``watched``, the dock; no ``event`` is kept from it."""
        if event.type() in (QEvent.Type.WindowTitleChange, QEvent.Type.WindowIconChange):
            self.update_title()
        return False

    def mouseDoubleClickEvent(self, event):
        if self._dock.features() & QDockWidget.DockWidgetFeature.DockWidgetFloatable:
            self._dock.setFloating(not self._dock.isFloating())

    def _show_menu(self, position):
        menu = QMenu(self)
        menu.addAction("Rename dock widget").triggered.connect(
            lambda checked=False: QTimer.singleShot(0, self._start_rename)
        )  # the menu, when it goes, gives the focus back
        for title, move in self._dock.other_places():
            menu.addAction(title).triggered.connect(lambda checked=False, move=move: move())
        menu.popup(self.mapToGlobal(position))

    def _start_rename(self):
        self.title_edit.setText(self._dock.windowTitle())
        self.title_label.hide()
        self.title_edit.show()
        self.title_edit.setFocus()
        self.title_edit.selectAll()

    def _finish_rename(self):
        if self.title_edit.isVisible():
            self.title_edit.hide()
            self.title_label.setVisible(not self._hide_title)
            if self.title_edit.text() != self._dock.windowTitle():
                self.rename(self.title_edit.text())

    def save_settings(self, settings):
        settings.set_value("dock_widget_title", self._dock.windowTitle())
        settings.set_value("renamed", self._named is not None)
        settings.set_value("dockable", self.dockable_button.isChecked())

    def restore_settings(self, settings):
        title = settings.value("dock_widget_title")
        if isinstance(title, str) and title and settings.value("renamed", True) in (True, "true"):
            self.rename(title)
        self.dockable_button.setChecked(settings.value("dockable", True) in (True, "true"))
