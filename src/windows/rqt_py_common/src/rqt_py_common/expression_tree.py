"""A tree view in which the expressions of messages are edited."""

import re

from python_qt_binding.QtCore import Qt, Signal
from python_qt_binding.QtGui import QBrush, QColor
from python_qt_binding.QtWidgets import QTreeWidget, QTreeWidgetItem

from .message_template import Field, TemplateError

_FIELD = Qt.ItemDataRole.UserRole


class ExpressionTree(QTreeWidget):
    """Rows of fields; subclasses and owners add rows above them.

    :param type_column: where the type is shown, and the size of arrays edited
    :param expression_column: where expressions are edited
    """

    edited = Signal(object)  # the Field that has another expression or size

    def __init__(self, columns, type_column: int, expression_column: int):
        super().__init__()
        self.setColumnCount(len(columns))
        self.setHeaderLabels(columns)
        self.setAlternatingRowColors(True)
        self._type_column, self._expression_column = type_column, expression_column
        self.setEditTriggers(QTreeWidget.EditTrigger.NoEditTriggers)
        self.itemDoubleClicked.connect(self._double_clicked)
        self.itemChanged.connect(self._item_changed)

    def add_fields(self, parent, field: Field) -> None:
        """Rows below ``parent`` for all that is within a field."""
        blocked = self.blockSignals(True)
        for child in field.children:
            row = QTreeWidgetItem()
            row.setText(0, child.name)
            self._fill(row, child)
            parent.addChild(row)
            self.add_fields(row, child)
        self.blockSignals(blocked)

    def editable(self, item, column: int) -> bool:
        """Whether a double click edits the cell of ``item`` in ``column``; owners of other rows extend it."""
        field = self.field_of(item)
        if field is None:
            return False
        return column == self._expression_column and field.expression is not None or column == self._type_column and field.resizable

    @staticmethod
    def field_of(item) -> Field | None:
        return item.data(0, _FIELD)

    def show_error(self, item, error: TemplateError | None) -> None:
        """Mark the field below ``item`` that an error is about; None clears all marks there."""
        blocked = self.blockSignals(True)
        for row in range(item.childCount()):
            child = item.child(row)
            field = self.field_of(child)
            wrong = error is not None and field is not None and field.expression is not None and field.path == error.path
            child.setForeground(self._expression_column, QBrush(QColor("red")) if wrong else QBrush())
            child.setToolTip(self._expression_column, error.text if error is not None and wrong else "")
            self.show_error(child, error)
        self.blockSignals(blocked)

    def _fill(self, row, field: Field) -> None:
        row.setData(0, _FIELD, field)
        row.setText(self._type_column, field.shown_type())
        row.setText(self._expression_column, field.expression or "")
        row.setFlags(row.flags() | Qt.ItemFlag.ItemIsEditable)
        if field.resizable:
            row.setToolTip(self._type_column, "Double-click and change the number to have that many elements.")

    def _double_clicked(self, item, column) -> None:
        if self.editable(item, column):
            self.editItem(item, column)

    def _item_changed(self, item, column) -> None:
        field = self.field_of(item)
        if field is None:
            return
        if column == self._expression_column and field.expression is not None:
            field.expression = item.text(column)
        elif column == self._type_column and field.resizable:
            self._resize(item, field, item.text(column))
        else:
            return
        self.edited.emit(field)

    def _resize(self, item, field: Field, text: str) -> None:
        blocked = self.blockSignals(True)
        size = re.search(r"(\d{1,9})\]?\s*$", text)
        try:
            if size:
                field.resize(int(size.group(1)))
        except TemplateError as error:
            item.setToolTip(self._type_column, str(error))
        else:
            item.takeChildren()
            self.add_fields(item, field)
            item.setExpanded(True)
        item.setText(self._type_column, field.shown_type())
        self.blockSignals(blocked)
