"""What all screens have in common: a title, what it is about, and the pieces that several of them are built from."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from python_qt_binding.QtCore import Qt, Signal
from python_qt_binding.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QFormLayout,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QLineEdit,
    QListWidget,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)

from moveit_setup_assistant.errors import AssistantError


class Screen(QWidget):
    """One step of the assistant. ``session`` carries the configuration and the view; None before a robot is loaded."""

    title = ""
    about = ""

    def __init__(self, session) -> None:
        super().__init__()
        self.session = session
        self.setObjectName(f"screen_{type(self).__module__.rsplit('.', 1)[-1]}")
        self.layout_ = QVBoxLayout(self)
        self.layout_.setContentsMargins(3, 0, 3, 0)
        heading = QLabel(f"<h2>{self.title}</h2>")
        text = QLabel(self.about)
        text.setWordWrap(True)
        self.layout_.addWidget(heading)
        self.layout_.addWidget(text)

    @property
    def config(self):
        """The configuration that is edited."""
        return self.session.config

    def enter(self) -> None:
        """The screen is shown: fill it from the configuration."""

    def leave(self) -> str | None:
        """The screen is left: put what was typed into the configuration; a line if that cannot be done."""
        return None


class TwoLists(QWidget):
    """Names to choose from on the left, the chosen ones on the right, in the order in which they were chosen.

    ``changed`` is sent after each change, ``looked_at`` with the names that are marked on either side.
    """

    changed = Signal()
    looked_at = Signal(list)

    def __init__(self, left: str, right: str, name: str) -> None:
        super().__init__()
        self.setObjectName(name)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        self._all: list[str] = []
        self._names: list[str] = []
        self._moves: dict[str, QPushButton] = {}
        self._left, self._right = self._list(f"{name}_available"), self._list(f"{name}_chosen")
        for title, widget in ((left, self._left), (None, self._buttons(name)), (right, self._right)):
            column = QVBoxLayout()
            if title:
                column.addWidget(QLabel(title))
            column.addWidget(widget)
            layout.addLayout(column, 1 if title else 0)
        self._allow()

    def _list(self, name: str) -> QListWidget:
        made = QListWidget()
        made.setObjectName(name)
        made.setSelectionMode(QListWidget.ExtendedSelection)
        made.itemSelectionChanged.connect(lambda: self.looked_at.emit([i.text() for i in made.selectedItems()]))
        made.itemSelectionChanged.connect(self._allow)
        return made

    def _buttons(self, name: str) -> QWidget:
        box = QWidget()
        layout = QVBoxLayout(box)
        layout.addStretch(1)
        for text, action, which in ((">", self._take, "add"), ("<", self._give_back, "remove")):
            button = QPushButton(text)
            button.setObjectName(f"{name}_{which}")
            button.clicked.connect(action)
            button.setMaximumWidth(48)
            layout.addWidget(button)
            self._moves[which] = button
        layout.addStretch(1)
        return box

    def _allow(self) -> None:
        allow(self._moves["add"], "" if self._left.selectedItems() else "Mark names on the left first.")
        allow(self._moves["remove"], "" if self._right.selectedItems() else "Mark names on the right first.")

    def set(self, available: Iterable[str], chosen: Iterable[str]) -> None:
        """Show the names that are ``available``; those in ``chosen`` are on the right, and not offered again."""
        self._all, self._names = list(available), list(chosen)
        self._fill()

    def chosen(self) -> list[str]:
        """The names on the right."""
        return list(self._names)

    def _fill(self) -> None:
        for widget, names in ((self._left, [n for n in self._all if n not in self._names]), (self._right, self._names)):
            widget.blockSignals(True)
            widget.clear()
            widget.addItems(names)
            widget.blockSignals(False)
        self._allow()

    def _take(self) -> None:
        self._names += [item.text() for item in self._left.selectedItems()]
        self._fill()
        self.changed.emit()

    def _give_back(self) -> None:
        gone = {item.text() for item in self._right.selectedItems()}
        self._names = [name for name in self._names if name not in gone]
        self._fill()
        self.changed.emit()


class Table(QTableWidget):
    """Rows of texts below headers; one row at a time is marked, and nothing is typed into them.

    Columns are as wide as what is in them, the last one at least what is left of the table's width.
    """

    def __init__(self, name: str, headers: Iterable[str]) -> None:
        headers = list(headers)
        super().__init__(0, len(headers))
        self.setObjectName(name)
        self.setHorizontalHeaderLabels(headers)
        self.setEditTriggers(QAbstractItemView.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectRows)
        self.setSelectionMode(QAbstractItemView.SingleSelection)
        self.setAlternatingRowColors(True)
        self.verticalHeader().hide()
        self.verticalHeader().setDefaultSectionSize(self.fontMetrics().height() + 8)
        header = self.horizontalHeader()
        header.setHighlightSections(False)
        header.setDefaultAlignment(Qt.AlignLeft | Qt.AlignVCenter)
        header.setSectionResizeMode(QHeaderView.Fixed)
        self.spread()

    def show_rows(self, rows: Iterable[Iterable[str]], row: int = -1) -> None:
        """Show ``rows``, the texts of each, and mark the one with the number ``row``, from 0; -1 for none."""
        rows = [list(cells) for cells in rows]
        self.blockSignals(True)
        self.setRowCount(len(rows))
        for index, cells in enumerate(rows):
            self.write(index, cells)
        self.clearSelection()
        self.setCurrentCell(-1, -1)
        self.blockSignals(False)
        self.spread()
        if row >= 0:
            self.selectRow(row)

    def write(self, row: int, cells: Iterable[str]) -> None:
        """Put ``cells``, texts, into the row with the number ``row``, from the left."""
        for column, text in enumerate(cells):
            item = QTableWidgetItem(text)
            item.setToolTip(text)
            self.setItem(row, column, item)

    def rewrite(self, row: int, cells: Iterable[str]) -> None:
        """Put other texts, ``cells``, into the row with the number ``row``, which is shown."""
        self.blockSignals(True)
        self.write(row, cells)
        self.blockSignals(False)
        self.spread()

    def resizeEvent(self, event) -> None:
        super().resizeEvent(event)
        self.spread()

    def spread(self) -> None:
        """Make every column as wide as its texts."""
        self.resizeColumnsToContents()
        last = self.columnCount() - 1
        used = sum(self.columnWidth(column) for column in range(last))
        self.setColumnWidth(last, max(self.columnWidth(last), self.viewport().width() - used))

    def row(self) -> int:
        """The marked row, -1 if there is none."""
        rows = self.selectionModel().selectedRows()
        return rows[0].row() if rows else -1


class Entries(QWidget):
    """A table of things with a form for the one that is marked, and buttons to add, change and delete.

    What cannot be done is greyed, and the line below the form says why.

    :param columns: the table's headers. :param cells: a thing's texts in them.
    :param fields: key -> (label, widget); QLineEdit and QComboBox are understood.
    :param read: fills the form: ``read(thing) -> {key: text}``. :param things: the list as it is now.
    :param check: ``check(thing or None, {key: text})`` raises AssistantError if the form cannot become this thing, or a new one.
    :param write: takes a form that was checked: changes the thing, or adds one. :param delete: takes a thing out.
    """

    looked_at, changed = Signal(object), Signal()  # the thing that is marked; the things are others than before

    def __init__(
        self,
        name: str,
        what: str,
        columns: Iterable[str],
        fields: dict[str, tuple],
        things: Callable[[], list],
        cells: Callable,
        read: Callable,
        check: Callable,
        write: Callable,
        delete: Callable,
    ) -> None:
        super().__init__()
        self._things, self._cells, self._read, self._check = things, cells, read, check
        self._write, self._delete = write, delete
        self._fields = {key: widget for key, (_, widget) in fields.items()}
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        self._table = Table(f"{name}_list", columns)
        self._table.itemSelectionChanged.connect(self._show)
        layout.addWidget(self._table)
        form = form_layout()
        for key, (text, widget) in fields.items():
            widget.setObjectName(f"{name}_{key}")
            add_row(form, text, widget)
            (widget.currentTextChanged if isinstance(widget, QComboBox) else widget.textChanged).connect(self._allow)
        layout.addLayout(form)
        self._hint = hint(f"{name}_hint")
        layout.addWidget(self._hint)
        layout.addLayout(self._make_buttons(name, what))

    def _make_buttons(self, name: str, what: str) -> QHBoxLayout:
        row = QHBoxLayout()
        self._buttons = {}
        for text, which, action in (
            (f"&Add {what}", "add", self._add),
            ("&Change", "change", self._change),
            ("&Delete", "delete", self._remove),
        ):
            button = self._buttons[which] = QPushButton(text)
            button.setObjectName(f"{name}_{which}")
            button.clicked.connect(action)
            allow(button, "Load a robot first.")
            row.addWidget(button)
        return row

    def fill(self, row: int = -1) -> None:
        """Show the things as they are now."""
        self._table.show_rows([self._cells(thing) for thing in self._things()], row)
        self._allow()
        self.changed.emit()

    def offer(self, key: str, names: Iterable[str]) -> None:
        """The choices, ``names``, of the field ``key``, which is a QComboBox."""
        box = self._fields[key]
        chosen = box.currentText()
        box.blockSignals(True)
        box.clear()
        box.addItems(list(names))
        box.setCurrentText(chosen)
        box.blockSignals(False)

    def values(self) -> dict[str, str]:
        """What the form says."""
        return {key: w.currentText() if isinstance(w, QComboBox) else w.text().strip() for key, w in self._fields.items()}

    def _marked(self):
        row, things = self._table.row(), self._things()
        return things[row] if 0 <= row < len(things) else None

    def _refused(self, thing) -> str:
        """Why the form cannot become this thing, or a new one (None); "" if it can."""
        try:
            self._check(thing, self.values())
        except AssistantError as error:
            return str(error)
        return ""

    def _allow(self, *_) -> None:
        """Enable what can be done now."""
        marked, new = self._marked(), self._refused(None)
        same = marked is not None and self._read(marked) == self.values()
        other = self._refused(marked) if marked is not None else "Mark one in the table first."
        allow(self._buttons["add"], new)
        allow(self._buttons["change"], "Nothing is changed yet." if same else other)
        allow(self._buttons["delete"], "" if marked is not None else "Mark one in the table first.")
        self._hint.setText("" if same or not (marked is None or other) else (other if marked is not None else new))

    def _show(self) -> None:
        thing = self._marked()
        if thing is not None:
            for key, text in self._read(thing).items():
                widget = self._fields[key]
                (widget.setCurrentText if isinstance(widget, QComboBox) else widget.setText)(text)
            self.looked_at.emit(thing)
        self._allow()

    def _add(self) -> None:
        self._write(None, self.values())
        self.fill(len(self._things()) - 1)

    def _change(self) -> None:
        row = self._table.row()
        self._write(self._things()[row], self.values())
        self.fill(row)

    def _remove(self) -> None:
        row = self._table.row()
        self._delete(self._things()[row])
        self.fill(min(row, len(self._things()) - 1))


def allow(button: QWidget, why_not: str) -> None:
    """Enable the widget ``button`` if ``why_not`` is empty: it is the reason against it, and its tool tip."""
    button.setEnabled(not why_not)
    button.setToolTip(why_not)


def hint(name: str, colour: str = "#505050") -> QLabel:
    """A line below a form: what is missing, or wrong.

    :param name: object name
    :param colour: of the text, as style sheets name it
    """
    made = QLabel()
    made.setObjectName(name)
    made.setWordWrap(True)
    made.setStyleSheet(f"color: {colour}")
    return made


def add_row(form: QFormLayout, text: str, widget: QWidget) -> None:
    """A row of a ``form``, ``text`` beside ``widget``; names of plugins are long, and get a line of their own below their label."""
    if isinstance(widget, QComboBox) and widget.isEditable():
        form.addRow(QLabel(text))
        form.addRow(widget)
    else:
        form.addRow(text, widget)


def form_layout(parent: QWidget | None = None) -> QFormLayout:
    """A form whose long labels stand above their fields where the window is narrow."""
    made = QFormLayout(parent) if parent is not None else QFormLayout()
    made.setRowWrapPolicy(QFormLayout.WrapLongRows)
    made.setFieldGrowthPolicy(QFormLayout.AllNonFixedFieldsGrow)
    return made


def line(text: str = "") -> QLineEdit:
    """A field for a line of text."""
    return QLineEdit(text)


def choice(names: Iterable[str] = (), editable: bool = False) -> QComboBox:
    """A field to choose one of ``names`` from; it takes the width it is given, and cuts what is longer.

    :param editable: another text may be typed
    """
    made = QComboBox()
    made.addItems(list(names))
    made.setEditable(editable)
    made.setMinimumContentsLength(12)
    made.setSizeAdjustPolicy(QComboBox.AdjustToMinimumContentsLengthWithIcon)
    return made


CHECKED, UNCHECKED = Qt.Checked, Qt.Unchecked
