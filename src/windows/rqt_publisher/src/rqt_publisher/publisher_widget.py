"""What is seen of the publishers."""

from python_qt_binding.QtCore import QSize, Qt, Signal
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import (
    QComboBox,
    QHBoxLayout,
    QLabel,
    QMenu,
    QPushButton,
    QSizePolicy,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)
from rqt_py_common.empty_text import EmptyText
from rqt_py_common.expression_tree import ExpressionTree
from rqt_py_common.extended_combo_box import ExtendedComboBox

TOPIC, TYPE, RATE, EXPRESSION = range(4)
RATES = ("0", "1", "2", "5", "10", "20", "50", "100")


class PublisherTree(ExpressionTree):
    """Rows of publishers with a check box each, and their fields below."""

    def __init__(self):
        super().__init__(("topic", "type", "rate", "expression"), TYPE, EXPRESSION)
        self.setObjectName("publisher_tree_widget")
        for column, width in enumerate((260, 180, 60, 200)):
            self.setColumnWidth(column, width)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)

    def editable(self, item, column):
        """Whether a double click edits the ``column`` of ``item``: of a publisher, its rate."""
        return item.parent() is None and column == RATE or super().editable(item, column)


class PublisherWidget(QWidget):
    add_requested = Signal(str, str, str)  # topic, type, rate
    remove_requested = Signal(object)  # a publisher
    clear_requested = Signal()
    refresh_requested = Signal()

    def __init__(self):
        super().__init__()
        self.setObjectName("PublisherWidget")
        self.setWindowTitle("Message Publisher")
        self._rows = {}  # publisher -> item
        self._types_of = {}
        self.topic_combo_box, self.type_combo_box, self.frequency_combo_box = ExtendedComboBox(), ExtendedComboBox(), QComboBox()
        self.topic_combo_box.setObjectName("topic_combo_box")
        self.type_combo_box.setObjectName("type_combo_box")
        self.frequency_combo_box.setObjectName("frequency_combo_box")
        self.frequency_combo_box.setEditable(True)
        self.frequency_combo_box.addItems(RATES)
        self.frequency_combo_box.setCurrentIndex(1)
        for box in (self.topic_combo_box, self.type_combo_box):
            box.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
            box.setMinimumContentsLength(12)
        self.topic_combo_box.currentTextChanged.connect(self._topic_changed)
        bar = QHBoxLayout()
        self._button(bar, "refresh_button", "view-refresh", "", "Look for topics", self.refresh_requested.emit)
        for text, box in (("Topic", self.topic_combo_box), ("Type", self.type_combo_box), ("Freq.", self.frequency_combo_box)):
            bar.addWidget(QLabel(text))
            bar.addWidget(box)
        bar.addWidget(QLabel("Hz"))
        self._button(bar, "add_publisher_button", "list-add", "+", "Add a publisher", self._add)
        self._button(bar, "remove_publisher_button", "list-remove", "-", "Remove the selected publishers", self._remove_selected)
        self._button(bar, "clear_button", "edit-clear", "Clear", "Remove all publishers", self.clear_requested.emit)
        self.tree = PublisherTree()
        EmptyText(self.tree, "Choose a topic above and press + to publish on it.")
        self.tree.itemChanged.connect(self._item_changed)
        self.tree.customContextMenuRequested.connect(self._show_menu)
        self.error_label = QLabel()
        self.error_label.setObjectName("error_label")
        self.error_label.setStyleSheet("color: red")
        self.error_label.setWordWrap(True)
        self.error_label.hide()
        layout = QVBoxLayout(self)
        layout.addLayout(bar)
        layout.addWidget(self.tree)
        layout.addWidget(self.error_label)

    def _button(self, bar, name, icon, text, tip, call):
        button = QPushButton(QIcon.fromTheme(icon), text)
        button.setObjectName(name)
        button.setToolTip(tip)
        button.clicked.connect(lambda: call())
        bar.addWidget(button)

    def sizeHint(self) -> QSize:
        return QSize(850, 450)

    def set_topics(self, topics) -> None:
        """Offer (name, type) pairs."""
        self._types_of = dict(topics)
        text = self.topic_combo_box.currentText()
        self.topic_combo_box.onSetItems(sorted(self._types_of))
        self.topic_combo_box.setEditText(text or self.topic_combo_box.currentText())
        self._topic_changed(self.topic_combo_box.currentText())

    def set_types(self, installed) -> None:
        """Offer types: names of packages to names of types."""
        text = self.type_combo_box.currentText()
        self.type_combo_box.onSetItems([f"{package}/{name}" for package, names in installed.items() for name in names])
        if text:
            self.type_combo_box.setEditText(text)

    def _topic_changed(self, topic: str) -> None:
        if topic in self._types_of:
            self.type_combo_box.setEditText(self._types_of[topic])

    def _add(self) -> None:
        self.add_requested.emit(
            self.topic_combo_box.currentText().strip(),
            self.type_combo_box.currentText().strip(),
            self.frequency_combo_box.currentText().strip(),
        )

    def add_entry(self, entry) -> None:
        item = QTreeWidgetItem([entry.topic, entry.type_name, f"{entry.rate:1.2f}", ""])
        item.setFlags(item.flags() | Qt.ItemFlag.ItemIsUserCheckable | Qt.ItemFlag.ItemIsEditable)
        item.setCheckState(TOPIC, Qt.CheckState.Unchecked)
        self._rows[entry] = item
        blocked = self.tree.blockSignals(True)
        self.tree.addTopLevelItem(item)
        self.tree.add_fields(item, entry.template)
        self.tree.blockSignals(blocked)
        self.tree.setCurrentItem(item)

    def remove_entry(self, entry) -> None:
        self.tree.takeTopLevelItem(self.tree.indexOfTopLevelItem(self._rows.pop(entry)))

    def item_of(self, entry) -> QTreeWidgetItem:
        return self._rows[entry]

    def show_result(self, entry) -> None:
        """After an attempt to publish."""
        wrong, item = entry.error is not None, self._rows[entry]
        if wrong or item.text(EXPRESSION):
            self.tree.show_error(item, entry.error)
            blocked = self.tree.blockSignals(True)
            item.setText(EXPRESSION, "# not published" if wrong else "")
            self.tree.blockSignals(blocked)
            self.show_error(f"{entry.topic}: {entry.error}" if wrong else "")

    def show_error(self, text: str) -> None:
        self.error_label.setText(text)
        self.error_label.setVisible(bool(text))

    def _entry_of(self, item):
        while item is not None and item.parent() is not None:
            item = item.parent()
        return next((entry for entry, row in self._rows.items() if row is item), None)

    def selected_entries(self) -> list:
        found = [self._entry_of(item) for item in self.tree.selectedItems()]
        return list(dict.fromkeys(entry for entry in found if entry is not None))

    def _remove_selected(self) -> None:
        for entry in self.selected_entries():
            self.remove_requested.emit(entry)

    def _item_changed(self, item, column) -> None:
        entry = self._entry_of(item) if item.parent() is None else None
        if entry is None:
            return
        if column == TOPIC:
            entry.set_enabled(item.checkState(TOPIC) == Qt.CheckState.Checked)
        elif column == RATE:
            from .publisher import parse_rate

            try:
                entry.set_rate(parse_rate(item.text(RATE)))
                self.show_error("")
            except ValueError as error:
                self.show_error(str(error))
            blocked = self.tree.blockSignals(True)
            item.setText(RATE, f"{entry.rate:1.2f}")
            self.tree.blockSignals(blocked)

    def row_menu(self) -> QMenu:
        """The menu of the selected rows."""
        menu, entries = QMenu(self), self.selected_entries()
        menu.addAction(QIcon.fromTheme("mail-forward"), "Publish Selected Once", lambda: [entry.publish() for entry in entries])
        menu.addAction(QIcon.fromTheme("list-remove"), "Remove Selected", self._remove_selected)
        menu.addSeparator()
        menu.addAction(QIcon.fromTheme("zoom-in"), "Expand All Children", lambda: self._expand(True))
        menu.addAction(QIcon.fromTheme("zoom-out"), "Collapse All Children", lambda: self._expand(False))
        return menu

    def _show_menu(self, place) -> None:
        if self.tree.itemAt(place) is not None:
            self.row_menu().popup(self.tree.viewport().mapToGlobal(place))

    def _expand(self, on: bool) -> None:
        def expand(item):
            item.setExpanded(on)
            for row in range(item.childCount()):
                expand(item.child(row))

        for item in self.tree.selectedItems():
            expand(item)
