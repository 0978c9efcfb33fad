"""The windows in which a plot and its curves are configured. They change a copy; OK hands it over."""

from __future__ import annotations

from python_qt_binding.QtCore import QMimeData, Qt
from python_qt_binding.QtGui import QDrag, QGuiApplication
from python_qt_binding.QtWidgets import (
    QAbstractItemView,
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QDoubleSpinBox,
    QFormLayout,
    QHBoxLayout,
    QLineEdit,
    QListWidget,
    QPushButton,
    QVBoxLayout,
)

from rqt_multiplot.config import ConfigError, Curve, Plot, PlotAxis, TitleType, copied, read_curve, write_curve
from rqt_multiplot.curve_dialog import CurveDialog
from rqt_multiplot.panel import CURVE_MIME


class CurveList(QListWidget):
    """Titles of curves; a title can be dragged onto a plot."""

    def __init__(self, curves: list[Curve]):
        super().__init__()
        self.setObjectName("curves")
        self.curves = curves
        self.setSelectionMode(QAbstractItemView.SelectionMode.ExtendedSelection)
        self.setDragEnabled(True)
        self.refresh()

    def refresh(self) -> None:
        row = self.currentRow()
        self.clear()
        self.addItems([curve.title for curve in self.curves])
        self.setCurrentRow(min(row, self.count() - 1))

    def selected(self) -> list[int]:
        return sorted(index.row() for index in self.selectedIndexes())

    def startDrag(self, _actions) -> None:
        for row in self.selected()[:1]:
            data = QMimeData()
            data.setData(CURVE_MIME, write_curve(self.curves[row]).encode())
            drag = QDrag(self)
            drag.setMimeData(data)
            drag.exec_(Qt.DropAction.CopyAction) if hasattr(drag, "exec_") else drag.exec(Qt.DropAction.CopyAction)


class _AxisTitle(QHBoxLayout):
    """Automatic or own title of an axis, shown or not."""

    def __init__(self, axis: PlotAxis):
        super().__init__()
        self.axis = axis
        self.visible, self.automatic, self.text = QCheckBox("Visible"), QCheckBox("Auto"), QLineEdit(axis.custom_title)
        self.visible.setChecked(axis.title_visible)
        self.automatic.setChecked(axis.title_type == TitleType.AUTO)
        self.text.setDisabled(self.automatic.isChecked())
        self.automatic.toggled.connect(self.text.setDisabled)
        for widget in (self.text, self.automatic, self.visible):
            self.addWidget(widget)

    def apply(self) -> None:
        self.axis.title_visible = self.visible.isChecked()
        self.axis.title_type = TitleType.AUTO if self.automatic.isChecked() else TitleType.CUSTOM
        self.axis.custom_title = self.text.text()


class PlotDialog(QDialog):
    """Configures one plot.

    :param plot: copied; :attr:`plot` is the copy with the changes once the dialog is accepted. :param types: knows the topics.
    """

    def __init__(self, plot: Plot, types, parent=None):
        super().__init__(parent)
        self.plot = copied(plot)
        self._types = types
        self.setWindowTitle("Configure Plot")
        self.title = QLineEdit(self.plot.title)
        self.title.setObjectName("title")
        self.rate = QDoubleSpinBox()
        self.rate.setRange(0.01, 100.0)
        self.rate.setSuffix(" Hz")
        self.rate.setValue(self.plot.plot_rate)
        self.legend = QCheckBox("Visible")
        self.legend.setChecked(self.plot.legend.visible)
        self.x_title, self.y_title = _AxisTitle(self.plot.axes.axes.x_axis), _AxisTitle(self.plot.axes.axes.y_axis)
        self.list = CurveList(self.plot.curves)
        self.list.itemDoubleClicked.connect(lambda _item: self.edit_curve())
        form = QFormLayout(self)
        form.addRow("Title", self.title)
        form.addRow("Curves", self._curve_row())
        form.addRow("X axis title", self.x_title)
        form.addRow("Y axis title", self.y_title)
        form.addRow("Legend", self.legend)
        form.addRow("Plot rate", self.rate)
        box = QDialogButtonBox(QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel)
        box.accepted.connect(self.accept)
        box.rejected.connect(self.reject)
        form.addRow(box)
        self.resize(520, 420)

    def _curve_row(self) -> QHBoxLayout:
        row, column = QHBoxLayout(), QVBoxLayout()
        for text, tip, action in (
            ("Add...", "A new curve", self.add_curve),
            ("Edit...", "The selected curve", self.edit_curve),
            ("Remove", "The selected curves", self.remove_curves),
            ("Copy", "To the clipboard", self.copy_curve),
            ("Paste", "From the clipboard", self.paste_curve),
        ):
            button = QPushButton(text)
            button.setObjectName(text.strip(".").lower() + "_curve")
            button.setToolTip(tip)
            button.setAutoDefault(False)
            button.clicked.connect(lambda _checked=False, action=action: action())
            column.addWidget(button)
        column.addStretch()
        row.addWidget(self.list, 1)
        row.addLayout(column)
        return row

    def _open(self, curve: Curve, index: int | None) -> None:
        dialog = self.curve_dialog = CurveDialog(curve, self._types, self)
        dialog.accepted.connect(lambda: self._take(dialog.curve, index))
        dialog.show()

    def _take(self, curve: Curve, index: int | None) -> None:
        if index is None:
            self.plot.curves.append(curve)
        else:
            self.plot.curves[index] = curve
        self.list.refresh()

    def add_curve(self) -> None:
        self._open(Curve(), None)

    def edit_curve(self) -> None:
        for row in self.list.selected()[:1]:
            self._open(self.plot.curves[row], row)

    def remove_curves(self) -> None:
        for row in reversed(self.list.selected()):
            del self.plot.curves[row]
        self.list.refresh()

    def copy_curve(self) -> None:
        for row in self.list.selected()[:1]:
            QGuiApplication.clipboard().setText(write_curve(self.plot.curves[row]))

    def paste_curve(self) -> None:
        try:
            self.plot.curves.append(read_curve(QGuiApplication.clipboard().text()))
        except ConfigError:
            return  # something else is in the clipboard
        self.list.refresh()

    def accept(self) -> None:
        self.plot.title = self.title.text()
        self.plot.plot_rate = self.rate.value()
        self.plot.legend.visible = self.legend.isChecked()
        self.x_title.apply()
        self.y_title.apply()
        super().accept()
