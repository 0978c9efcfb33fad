"""A menu in three parts: prefix, items in alphabetical order, suffix."""

from python_qt_binding.QtCore import QObject
from python_qt_binding.QtWidgets import QMenu

from qt_gui.application.compatibility import QAction


class MenuManager(QObject):
    """Keeps the items of a menu sorted between its prefix and its suffix. An item is a ``QAction`` or a ``QMenu``."""

    def __init__(self, menu):
        super().__init__(menu)
        self.setObjectName("MenuManager")
        self.menu = menu
        self._items = []  # (label, action), sorted
        self._prefix = self._suffix = None  # separators

    def add_prefix(self, item):
        if self._prefix is None:
            first = self.menu.actions()[0] if self.menu.actions() else None
            self._prefix = self.menu.insertSeparator(first)
        self.menu.insertAction(self._prefix, item)

    def add_suffix(self, item):
        """Append ``item``, or a separator for None."""
        if self._suffix is None:
            self._suffix = self.menu.addSeparator()
        if item is None:
            self.menu.addSeparator()
        else:
            self.menu.addAction(item)

    def add_item(self, item):
        action = item.menuAction() if isinstance(item, QMenu) else item
        label = _plain(action.text())
        later = [other for other in self._items if (other[0].lower(), other[0]) > (label.lower(), label)]
        before = later[0][1] if later else self._suffix
        if before is None:
            self.menu.addAction(action)
        else:
            self.menu.insertAction(before, action)
        self._items.insert(len(self._items) - len(later), (label, action))

    def contains_menu(self, label):
        return self.get_menu(label) is not None

    def get_menu(self, label):
        for name, action in self._items:
            if name == _plain(label) and action.menu() is not None:
                return action.menu()
        return None

    def count_items(self):
        return len(self._items)

    def item(self, label) -> QAction:
        """The action of that label, or None."""
        return next((action for name, action in self._items if name == label), None)

    def remove_item(self, item):
        """Remove an item, given itself or its label."""
        for entry in list(self._items):
            if entry[1] is item or entry[0] == item:
                self._items.remove(entry)
                self.menu.removeAction(entry[1])


def _plain(text):
    return text.replace("&", "")
