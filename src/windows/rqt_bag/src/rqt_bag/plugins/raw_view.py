"""The fields of a message as a tree."""

from __future__ import annotations

import genpy
from python_qt_binding.QtCore import Qt
from python_qt_binding.QtGui import QKeySequence
from python_qt_binding.QtWidgets import QAbstractItemView, QApplication, QTreeWidget, QTreeWidgetItem

from rqt_bag.plugins.topic_message_view import TopicMessageView

_PATH = Qt.ItemDataRole.UserRole
_MOST_ELEMENTS = 200  # of an array: an image has millions


class RawView(TopicMessageView):
    """Shows all fields."""

    name = "Raw"

    def __init__(self, timeline, parent, topic):
        super().__init__(timeline, parent, topic)
        self.message_tree = MessageTree(parent)
        parent.layout().addWidget(self.message_tree)

    def message_viewed(self, bag, msg_details):
        super().message_viewed(bag, msg_details)
        self.message_tree.set_message(msg_details[1])

    def message_cleared(self):
        self.message_tree.set_message(None)


class MessageTree(QTreeWidget):
    """A tree of a message's fields; what the user has opened stays open with the next message."""

    def __init__(self, parent):
        super().__init__(parent)
        self.setObjectName("message_tree")
        self.setHeaderLabel("")
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self._msg = None
        self._expanded: set = set()
        self.itemExpanded.connect(lambda item: self._expanded.add(item.data(0, _PATH)))
        self.itemCollapsed.connect(lambda item: self._expanded.discard(item.data(0, _PATH)))

    @property
    def msg(self):
        return self._msg

    def set_message(self, msg):
        """Show another message, or with None nothing."""
        self._msg = msg
        blocked = self.blockSignals(True)
        self.clear()
        self.setHeaderLabel(msg._type if msg is not None else "")
        if msg is not None:
            for name in msg.__slots__:
                self._add(self.invisibleRootItem(), name, name, getattr(msg, name))
        self.blockSignals(blocked)

    def _add(self, parent: QTreeWidgetItem, path: str, label: str, value) -> None:
        item = QTreeWidgetItem(parent)
        item.setData(0, _PATH, path)
        children, text = [], ""
        if isinstance(value, genpy.Message):
            children = [(f"{path}.{name}", name, getattr(value, name)) for name in value.__slots__]
        elif isinstance(value, genpy.TVal):
            text = f"{value.to_sec():.9f}"
        elif isinstance(value, (bytes, bytearray)):
            shown = ", ".join(str(byte) for byte in value[:_MOST_ELEMENTS])
            text = f"[{shown}{', ...' if len(value) > _MOST_ELEMENTS else ''}] ({len(value)} bytes)"
        elif isinstance(value, (list, tuple)):
            children = [(f"{path}[{i}]", f"[{i}]", element) for i, element in enumerate(value[:_MOST_ELEMENTS])]
            more = f", the first {_MOST_ELEMENTS} shown" if len(value) > _MOST_ELEMENTS else ""
            text = f"{len(value)} element{'' if len(value) == 1 else 's'}{more}"
        else:
            text = f"{value:.9g}" if isinstance(value, float) else str(value)
        item.setText(0, f"{label}: {text}" if text else label)
        for child in children:
            self._add(item, *child)
        item.setExpanded(path in self._expanded)

    def get_all_items(self):
        """All items, from above."""
        items, waiting = [], [self.invisibleRootItem()]
        while waiting:
            item = waiting.pop(0)
            children = [item.child(i) for i in range(item.childCount())]
            items += children
            waiting = children + waiting
        return items

    def keyPressEvent(self, event):
        if event.matches(QKeySequence.StandardKey.Copy):
            QApplication.clipboard().setText("\n".join(item.text(0) for item in self.get_all_items() if item.isSelected()))
        elif event.matches(QKeySequence.StandardKey.SelectAll):
            self.expandAll()
            self.selectAll()
        else:
            super().keyPressEvent(event)
