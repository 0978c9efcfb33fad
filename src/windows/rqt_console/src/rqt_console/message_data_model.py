"""The table of messages: keeps the newest, hides what is excluded, sorts."""

import itertools
from collections import deque
from collections.abc import Iterable
from typing import Any

from python_qt_binding.QtCore import QAbstractTableModel, QModelIndex, Qt, Signal
from python_qt_binding.QtGui import QColor, QIcon
from rosgraph_msgs.msg import Log

from .filters.filter_collection import FilterCollection
from .message import Message

COLUMNS = ("#", "Message", "Severity", "Node", "Stamp", "Topics", "Location")
_COLORS = {Log.DEBUG: "darkcyan", Log.INFO: "darkblue", Log.WARN: "#808000", Log.ERROR: "darkred", Log.FATAL: "red"}
_ICONS = {Log.WARN: "dialog-warning", Log.ERROR: "dialog-error", Log.FATAL: "dialog-error"}
_TEXTS = (
    lambda m: f"#{m.id}",
    lambda m: m.message,
    Message.severity_text,
    lambda m: m.node,
    Message.stamp_text,
    Message.topics_text,
    lambda m: m.location,
)
_KEYS = (
    lambda m: m.id,
    lambda m: m.message,
    lambda m: m.severity,
    lambda m: m.node,
    lambda m: m.stamp,
    lambda m: m.topics_text(),
    lambda m: m.location,
)
MESSAGE_ROLE = Qt.ItemDataRole.UserRole


class MessageDataModel(QAbstractTableModel):
    """Newest first until :meth:`sort` says otherwise.

    ``exclude_filters`` and ``highlight_filters`` are its :class:`filters.filter_collection.FilterCollection`; call :meth:`refilter`
    after they have changed.
    """

    counts_changed = Signal()

    def __init__(self, message_limit: int = 20000):
        super().__init__()
        self.exclude_filters, self.highlight_filters = FilterCollection(), FilterCollection()
        self.only_highlighted = False
        self._limit = message_limit
        self._all: deque[Message] = deque()
        self._shown: list[Message] = []  # ascending by key
        self._column, self._descending = 0, True
        self._count = 0
        self._icons: dict[Any, Any] = {}
        self._grey = QColor("gray")
        self._colors = {level: QColor(name) for level, name in _COLORS.items()}

    # what Qt asks

    def rowCount(self, parent=QModelIndex()):
        return 0 if parent.isValid() else len(self._shown)

    def columnCount(self, parent=QModelIndex()):
        return 0 if parent.isValid() else len(COLUMNS)

    def headerData(self, section, orientation, role=Qt.ItemDataRole.DisplayRole):
        """Name of the column ``section``, or its tool tip, by ``role``; None for rows, which have the other ``orientation``."""
        if role == Qt.ItemDataRole.DisplayRole and orientation == Qt.Orientation.Horizontal:
            return COLUMNS[section]
        if role == Qt.ItemDataRole.ToolTipRole and orientation == Qt.Orientation.Horizontal:
            return "A click sorts; the right button chooses columns."
        return None

    def data(self, index, role=Qt.ItemDataRole.DisplayRole):
        """What the cell ``index`` has for ``role``, as Qt asks; the whole message for MESSAGE_ROLE."""
        if not index.isValid() or index.row() >= len(self._shown):
            return None
        message = self.message_of_row(index.row())
        if role == Qt.ItemDataRole.DisplayRole:
            text = _TEXTS[index.column()](message)
            return text if "\n" not in text else text.replace("\n", " ")
        if role == Qt.ItemDataRole.ForegroundRole:
            if self.highlight_filters.active() and not self.highlight_filters.test_message(message):
                return self._grey
            return self._colors.get(message.severity)
        if role == Qt.ItemDataRole.DecorationRole and index.column() == 1:
            return self._icon(message.severity)
        if role == Qt.ItemDataRole.ToolTipRole:
            return _TEXTS[index.column()](message)[:2000]
        return message if role == MESSAGE_ROLE else None

    def sort(self, column, order=Qt.SortOrder.AscendingOrder):
        """Show the messages by ``column``, from 0, in this ``order``."""
        self._rearrange(self._shown, column, order == Qt.SortOrder.DescendingOrder)

    # what the console asks

    @property
    def message_count(self) -> int:
        """All messages, the hidden too."""
        return len(self._all)

    def messages(self) -> list[Message]:
        """All messages in the order of arrival."""
        return list(self._all)

    def message_of_row(self, row: int) -> Message:
        return self._shown[len(self._shown) - 1 - row if self._descending else row]

    def get_message_limit(self) -> int:
        return self._limit

    def messages_since(self, seconds: float) -> list[Message]:
        """Messages whose stamp, in s, is at least this, the newest first; looked for among the newest until one is older."""
        return list(itertools.takewhile(lambda m: m.stamp[0] + m.stamp[1] * 1e-9 >= seconds, reversed(self._all)))

    def set_message_limit(self, limit: int) -> None:
        self._limit = limit
        self._trim()
        self.counts_changed.emit()

    def insert_rows(self, messages: Iterable[Message]) -> None:
        messages = list(messages)[-self._limit :]
        for message in messages:
            self._count += 1
            message.id = self._count
        self._all.extend(messages)
        shown = [message for message in messages if self._is_shown(message)]
        if shown and self._column == 0:
            first, last = (0, len(shown) - 1) if self._descending else (len(self._shown), len(self._shown) + len(shown) - 1)
            self.beginInsertRows(QModelIndex(), first, last)
            self._shown += shown
            self.endInsertRows()
        elif shown:
            self._rearrange(self._shown + shown)
        self._trim()
        self.counts_changed.emit()

    def remove_messages(self, messages: Iterable[Message]) -> None:
        gone = set(map(id, messages))
        self._all = deque(message for message in self._all if id(message) not in gone)
        self._rearrange([message for message in self._shown if id(message) not in gone])
        self.counts_changed.emit()

    def clear(self) -> None:
        self._all.clear()
        self._rearrange([])
        self.counts_changed.emit()

    def refilter(self) -> None:
        """The filters have changed."""
        self._rearrange([message for message in self._all if self._is_shown(message)])
        self.counts_changed.emit()

    def values(self, column: str) -> list[str]:
        """All that is there to choose from: ``node`` or ``topics``."""
        if column == "node":
            return sorted({message.node for message in self._all})
        return sorted({topic for message in self._all for topic in message.topics})

    def stamps(self) -> tuple | None:
        """The first and the last time of all messages; None without messages."""
        times = [message.stamp for message in self._all]
        return (min(times), max(times)) if times else None

    def _is_shown(self, message: Message) -> bool:
        if self.exclude_filters.test_message(message):
            return False
        return not (self.only_highlighted and self.highlight_filters.active()) or self.highlight_filters.test_message(message)

    def _trim(self) -> None:
        excess = len(self._all) - self._limit
        if excess <= 0:
            return
        for _ in range(excess - 1):
            self._all.popleft()
        last = self._all.popleft().id
        if self._column != 0:
            self._rearrange([message for message in self._shown if message.id > last])
            return
        gone = next((index for index, message in enumerate(self._shown) if message.id > last), len(self._shown))
        if gone:
            first = len(self._shown) - gone if self._descending else 0
            self.beginRemoveRows(QModelIndex(), first, first + gone - 1)
            del self._shown[:gone]
            self.endRemoveRows()

    def _rearrange(self, messages: list[Message], column: int | None = None, descending: bool = False) -> None:
        """Show these, sorted, in another order if a column is given; what was selected stays so."""
        self.layoutAboutToBeChanged.emit()
        old = self.persistentIndexList()
        kept = [self.message_of_row(index.row()) for index in old]
        if column is not None:
            self._column, self._descending = column, descending
        self._shown = sorted(messages, key=_KEYS[self._column])
        if old:
            rows = {id(message): row for row, message in enumerate(self._shown)}
            last = len(self._shown) - 1
            new = []
            for index, message in zip(old, kept):
                row = rows.get(id(message))
                new.append(QModelIndex() if row is None else self.index(last - row if self._descending else row, index.column()))
            self.changePersistentIndexList(old, new)
        self.layoutChanged.emit()

    def _icon(self, severity: int) -> QIcon:
        if severity not in self._icons:
            self._icons[severity] = QIcon.fromTheme(_ICONS.get(severity, "dialog-information"))
        return self._icons[severity]
