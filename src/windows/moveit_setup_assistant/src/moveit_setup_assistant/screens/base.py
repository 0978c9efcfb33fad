"""What all screens have in common: a title, what it is about, and the pieces that several of them are built from."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from python_qt_binding.QtCore import Qt, Signal
from python_qt_binding.QtWidgets import (
    QComboBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QListWidget,
    QPushButton,
    QVBoxLayout,
    QWidget,
)


class Screen(QWidget):
    """One step of the assistant. ``session`` carries the configuration and the view; None before a robot is loaded."""

    title = ""
    about = ""

    def __init__(self, session) -> None:
        super().__init__()
        self.session = session
        self.setObjectName(f"screen_{type(self).__module__.rsplit('.', 1)[-1]}")
        self.layout_ = QVBoxLayout(self)
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
        self._left, self._right = self._list(f"{name}_available"), self._list(f"{name}_chosen")
        for title, widget in ((left, self._left), (None, self._buttons(name)), (right, self._right)):
            column = QVBoxLayout()
            if title:
                column.addWidget(QLabel(title))
            column.addWidget(widget)
            layout.addLayout(column, 1 if title else 0)

    def _list(self, name: str) -> QListWidget:
        made = QListWidget()
        made.setObjectName(name)
        made.setSelectionMode(QListWidget.ExtendedSelection)
        made.itemSelectionChanged.connect(lambda: self.looked_at.emit([i.text() for i in made.selectedItems()]))
        return made

    def _buttons(self, name: str) -> QWidget:
        box = QWidget()
        layout = QVBoxLayout(box)
        for text, action, which in ((">", self._take, "add"), ("<", self._give_back, "remove")):
            button = QPushButton(text)
            button.setObjectName(f"{name}_{which}")
            button.clicked.connect(action)
            layout.addWidget(button)
        return box

    def set(self, available: Iterable[str], chosen: Iterable[str]) -> None:
        """Show these names; a chosen one is not offered again."""
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

    def _take(self) -> None:
        self._names += [item.text() for item in self._left.selectedItems()]
        self._fill()
        self.changed.emit()

    def _give_back(self) -> None:
        gone = {item.text() for item in self._right.selectedItems()}
        self._names = [name for name in self._names if name not in gone]
        self._fill()
        self.changed.emit()


class Entries(QWidget):
    """A list of things with a form for the one that is marked, and buttons to add and delete.

    :param fields: key -> (label, widget); QLineEdit and QComboBox are understood.
    :param read: fills the form: ``read(thing) -> {key: text}``.
    :param write: takes the form: ``write(thing or None, {key: text})`` changes the thing, or adds one; raises AssistantError.
    :param things: the list as it is now. :param label: text of a thing in the list. :param delete: takes a thing out.
    """

    looked_at = Signal(object)
    refused = Signal(str)

    def __init__(
        self,
        name: str,
        fields: dict[str, tuple],
        things: Callable[[], list],
        label: Callable,
        read: Callable,
        write: Callable,
        delete: Callable,
    ) -> None:
        super().__init__()
        self._things, self._label, self._read, self._write, self._delete = things, label, read, write, delete
        self._fields = {key: widget for key, (_, widget) in fields.items()}
        layout = QVBoxLayout(self)
        self._list = QListWidget()
        self._list.setObjectName(f"{name}_list")
        self._list.currentRowChanged.connect(self._show)
        layout.addWidget(self._list)
        form = QFormLayout()
        for key, (text, widget) in fields.items():
            widget.setObjectName(f"{name}_{key}")
            form.addRow(text, widget)
        layout.addLayout(form)
        buttons = QHBoxLayout()
        for text, which, action in (("Add", "add", self._add), ("Change", "change", self._change), ("Delete", "delete", self._remove)):
            button = QPushButton(text)
            button.setObjectName(f"{name}_{which}")
            button.clicked.connect(action)
            buttons.addWidget(button)
        layout.addLayout(buttons)

    def fill(self, row: int = -1) -> None:
        """Show the things as they are now."""
        self._list.clear()
        self._list.addItems([self._label(thing) for thing in self._things()])
        self._list.setCurrentRow(row)

    def offer(self, key: str, names: Iterable[str]) -> None:
        """The choices of a field that is a QComboBox."""
        box = self._fields[key]
        chosen = box.currentText()
        box.clear()
        box.addItems(list(names))
        box.setCurrentText(chosen)

    def values(self) -> dict[str, str]:
        """What the form says."""
        return {key: w.currentText() if isinstance(w, QComboBox) else w.text().strip() for key, w in self._fields.items()}

    def _show(self, row: int) -> None:
        things = self._things()
        if 0 <= row < len(things):
            for key, text in self._read(things[row]).items():
                widget = self._fields[key]
                (widget.setCurrentText if isinstance(widget, QComboBox) else widget.setText)(text)
            self.looked_at.emit(things[row])

    def _add(self) -> None:
        self._try(None, len(self._things()))

    def _change(self) -> None:
        row = self._list.currentRow()
        if row >= 0:
            self._try(self._things()[row], row)

    def _try(self, thing, row: int) -> None:
        from moveit_setup_assistant.errors import AssistantError

        try:
            self._write(thing, self.values())
        except AssistantError as error:
            self.refused.emit(str(error))
            return
        self.fill(row)

    def _remove(self) -> None:
        row = self._list.currentRow()
        if row >= 0:
            self._delete(self._things()[row])
            self.fill(min(row, len(self._things()) - 1))


def line(text: str = "") -> QLineEdit:
    """A field for a line of text."""
    return QLineEdit(text)


def choice(names: Iterable[str] = (), editable: bool = False) -> QComboBox:
    """A field to choose from."""
    made = QComboBox()
    made.addItems(list(names))
    made.setEditable(editable)
    made.setMinimumContentsLength(12)
    return made


CHECKED, UNCHECKED = Qt.Checked, Qt.Unchecked
