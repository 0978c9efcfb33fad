"""The boxes with rules: one line per condition, each with its editor."""

from collections.abc import Callable
from typing import Any

from python_qt_binding.QtCore import QDateTime, Qt
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import (
    QCheckBox,
    QDateTimeEdit,
    QGridLayout,
    QGroupBox,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QMenu,
    QScrollArea,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from .filters.filter_collection import FilterCollection
from .filters.kinds import KINDS
from .filters.list_filter import ListFilter
from .filters.text_filter import TextFilter
from .filters.time_filter import TimeFilter
from .message import SEVERITIES

_ROW_HEIGHT = 64  # px


class TextEditor(QWidget):
    """A text, and whether it is a regular expression."""

    def __init__(self, filter_: TextFilter, _values):
        super().__init__()
        self._filter = filter_
        state = filter_.state()
        self.text_edit, self.regex_check_box = QLineEdit(state["text"]), QCheckBox("Regex")
        self.text_edit.setObjectName("text_edit")
        self.regex_check_box.setChecked(state["regex"])
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.text_edit)
        layout.addWidget(self.regex_check_box)
        self.text_edit.textChanged.connect(self._set_text)
        self.regex_check_box.toggled.connect(self._set_regex)

    def _set_text(self, text):
        self._filter.set_text(text)
        self._show_error()

    def _set_regex(self, on):
        self._filter.set_regex(on)
        self._show_error()

    def _show_error(self):
        self.text_edit.setToolTip(self._filter.error)
        self.text_edit.setStyleSheet("color: red" if self._filter.error else "")


class ListEditor(QWidget):
    """A choice among the values that messages have had so far."""

    def __init__(self, filter_: ListFilter, values: Callable[[], list]):
        super().__init__()
        self._filter, self._values = filter_, values
        self.list_widget = QListWidget()
        self.list_widget.setSelectionMode(QListWidget.SelectionMode.ExtendedSelection)
        self.list_widget.setMaximumHeight(_ROW_HEIGHT)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.list_widget)
        self._fill()
        self.list_widget.itemSelectionChanged.connect(self._select)

    def refresh(self) -> None:
        """Look for values that are new."""
        if self._entries() != [self.list_widget.item(row).data(Qt.ItemDataRole.UserRole) for row in range(self.list_widget.count())]:
            self.list_widget.blockSignals(True)
            self._fill()
            self.list_widget.blockSignals(False)

    def _entries(self) -> list:
        known = list(self._values())
        return known + [value for value in self._filter.selected_items() if value not in known]

    def _fill(self) -> None:
        chosen = self._filter.selected_items()
        self.list_widget.clear()
        for value in self._entries():
            item = QListWidgetItem(SEVERITIES.get(value, str(value)))
            item.setData(Qt.ItemDataRole.UserRole, value)
            self.list_widget.addItem(item)
            item.setSelected(value in chosen)

    def _select(self) -> None:
        self._filter.set_selected_items([item.data(Qt.ItemDataRole.UserRole) for item in self.list_widget.selectedItems()])


class TimeEditor(QWidget):
    """Two times, the second one optional."""

    def __init__(self, filter_: TimeFilter, values: Callable[[], tuple]):
        super().__init__()
        state = filter_.state()
        if not state["start"]:
            first, last = values() or ((0, 0), (0, 0))
            state.update(start=first[0], stop=last[0] + 1)
            filter_.restore(state)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        edits = []
        for key, change in (("start", filter_.set_start_time), ("stop", filter_.set_stop_time)):
            edit = QDateTimeEdit(QDateTime.fromMSecsSinceEpoch(int(state[key] * 1000)))
            edit.setDisplayFormat("hh:mm:ss.zzz (yyyy-MM-dd)")
            edit.dateTimeChanged.connect(lambda value, change=change: change(value.toMSecsSinceEpoch() / 1000))
            layout.addWidget(edit)
            edits.append(edit)
        box = QCheckBox("until")
        box.setChecked(state["stop_enabled"])
        edits[1].setEnabled(state["stop_enabled"])
        box.toggled.connect(edits[1].setEnabled)
        box.toggled.connect(filter_.set_stop_time_enabled)
        layout.insertWidget(1, box)


class CustomEditor(QWidget):
    """Four conditions that must all hold."""

    def __init__(self, filter_, values):
        super().__init__()
        layout = QGridLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        self.editors = []
        for column, (name, part) in enumerate(filter_.parts.items()):
            layout.addWidget(QLabel(name), 0, column)
            editor = (TextEditor if isinstance(part, TextFilter) else ListEditor)(part, values[name])
            layout.addWidget(editor, 1, column)
            self.editors.append(editor)

    def refresh(self) -> None:
        for editor in self.editors:
            if isinstance(editor, ListEditor):
                editor.refresh()


class RuleBox(QGroupBox):
    """A list of conditions to edit.

    :param title: shown above
    :param filters: what the box edits
    :param model: a MessageDataModel, which knows the values to choose from
    """

    def __init__(self, title: str, filters: FilterCollection, model):
        super().__init__(title)
        self._filters = filters
        self._rows: dict[Any, tuple] = {}  # filter -> (row widget, editor, kind)
        self._values = {
            "severity": lambda: list(SEVERITIES),
            "node": lambda: model.values("node"),
            "topic": lambda: model.values("topics"),
            "time": model.stamps,
            "message": None,
            "location": None,
        }
        self._list = QVBoxLayout()
        self._list.addStretch()
        inner, scroll = QWidget(), QScrollArea()
        inner.setLayout(self._list)
        scroll.setWidget(inner)
        scroll.setWidgetResizable(True)
        self.add_button = QToolButton()
        self.add_button.setObjectName("add_button")
        self.add_button.setIcon(QIcon.fromTheme("list-add"))
        self.add_button.setText("+")
        self.add_button.setToolTip("Add a rule")
        self.add_button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(self.add_button)
        for kind, (label, _) in KINDS.items():
            menu.addAction(label, lambda kind=kind: self.add(kind))
        self.add_button.setMenu(menu)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(4, 4, 4, 4)
        layout.addWidget(self.add_button, 0, Qt.AlignmentFlag.AlignTop)
        layout.addWidget(scroll)

    def add(self, kind: str, state: dict | None = None, enabled: bool = True):
        """A new rule, as :meth:`state` has it; returns its filter.

        :param kind: a key of KINDS
        :param state: of the condition; None: as new
        :param enabled: it counts from now on
        """
        label, make = KINDS[kind]
        filter_ = make()
        if state is not None:
            filter_.restore(state)
        filter_.set_enabled(enabled)
        if isinstance(filter_, (TextFilter, ListFilter, TimeFilter)):
            editor = (TextEditor if isinstance(filter_, TextFilter) else TimeEditor if isinstance(filter_, TimeFilter) else ListEditor)(
                filter_, self._values[kind]
            )
        else:
            editor = CustomEditor(filter_, self._values)
        self._rows[filter_] = (self._row(filter_, label, editor, enabled), editor, kind)
        self._list.insertWidget(self._list.count() - 1, self._rows[filter_][0])
        self._filters.append(filter_)
        return filter_

    def remove(self, filter_) -> None:
        row = self._rows.pop(filter_)[0]
        self._filters.remove(filter_)
        self._list.removeWidget(row)
        row.deleteLater()

    def add_value(self, kind: str, value) -> None:
        """Let a rule of that kind have this value too: the last one there, or a new one."""
        rules = [filter_ for filter_, row in self._rows.items() if row[2] == kind]
        if isinstance(KINDS[kind][1](), ListFilter) and rules:
            filter_ = rules[-1]
            if value not in filter_.selected_items():
                filter_.set_selected_items(filter_.selected_items() + [value])
            self._rows[filter_][1]._fill()
        else:
            self.add(kind, {"text": value} if kind == "message" else {"selected": [value]})

    def refresh(self) -> None:
        """Offer values that messages have brought since."""
        for _, editor, _ in self._rows.values():
            if hasattr(editor, "refresh"):
                editor.refresh()

    def state(self) -> list:
        return [[kind, filter_.is_enabled(), filter_.state()] for filter_, (_, _, kind) in self._rows.items()]

    def restore(self, rules) -> None:
        for filter_ in list(self._rows):
            self.remove(filter_)
        for kind, enabled, state in rules:
            if kind in KINDS:
                self.add(kind, state, enabled)

    def _row(self, filter_, label: str, editor: QWidget, enabled: bool) -> QWidget:
        row = QWidget()
        layout = QHBoxLayout(row)
        layout.setContentsMargins(0, 0, 0, 0)
        box = QCheckBox(label)
        box.setChecked(enabled)
        box.toggled.connect(filter_.set_enabled)
        delete = QToolButton()
        delete.setIcon(QIcon.fromTheme("list-remove"))
        delete.setText("-")
        delete.setToolTip("Delete this rule")
        delete.clicked.connect(lambda: self.remove(filter_))
        layout.addWidget(box)
        layout.addWidget(editor, 1)
        layout.addWidget(delete)
        return row
