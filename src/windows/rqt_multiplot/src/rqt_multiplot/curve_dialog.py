"""The window in which one curve is configured."""

from __future__ import annotations

import roslib.message
import roslib.msgs
from python_qt_binding.QtCore import QStringListModel, Qt
from python_qt_binding.QtGui import QColor
from python_qt_binding.QtWidgets import (
    QCheckBox,
    QColorDialog,
    QComboBox,
    QCompleter,
    QDialog,
    QDialogButtonBox,
    QDoubleSpinBox,
    QFormLayout,
    QGridLayout,
    QGroupBox,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QSpinBox,
    QVBoxLayout,
)
from rqt_plot.fields import FieldError, slot_of

from rqt_multiplot.config import ColorType, Curve, CurveAxis, DataType, FieldType, Orientation, PenStyle, ScaleType, StyleType, copied

_PREFIXES = {ScaleType.ABSOLUTE: "absolute", ScaleType.RELATIVE: "relative"}
_DEEPEST = 8  # messages within messages that the list of fields goes into


def field_names(message_class, prefix: str = "", depth: int = 0) -> list[str]:
    """Fields of a message that hold numbers, as ``pose/pose/position/x``; of arrays the first element.

    :param message_class: None, for a type that is not built here: none
    :param prefix: put before each
    :param depth: of ``message_class`` in the message that was asked for
    """
    names: list[str] = []
    if message_class is None or depth > _DEEPEST:
        return names
    for name, kind in zip(message_class.__slots__, message_class._slot_types):
        base, is_array, _ = roslib.msgs.parse_type(kind)
        path = f"{prefix}{name}" + ("/0" if is_array else "")
        if base == "Header" or "/" in base:
            inner = roslib.message.get_message_class("std_msgs/Header" if base == "Header" else base)
            names += field_names(inner, path + "/", depth + 1)
        elif base != "string":
            names.append(path)
    return names


def _number(value: float) -> QDoubleSpinBox:
    box = QDoubleSpinBox()
    box.setDecimals(4)
    box.setRange(-1e12, 1e12)
    box.setValue(value)
    return box


def _choice(enum, chosen, names: list[str] | None = None) -> QComboBox:
    box = QComboBox()
    for item, name in zip(enum, names or [item.name.capitalize().replace("_", " ") for item in enum]):
        box.addItem(name, int(item))
    box.setCurrentIndex(box.findData(int(chosen)))
    return box


class AxisBox(QGroupBox):
    """Topic, type, field and scale of one axis."""

    def __init__(self, title: str, axis: CurveAxis, types):
        super().__init__(title)
        self._types = types
        self.topic, self.type = QComboBox(), QLineEdit()
        self.topic.setEditable(True)
        self.topic.addItems(sorted(types.types))
        self.type.setPlaceholderText("found when the topic exists")
        self.field = QLineEdit()
        self._fields = QStringListModel()
        completer = QCompleter(self._fields, self)
        completer.setFilterMode(Qt.MatchFlag.MatchContains)
        completer.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
        self.field.setCompleter(completer)
        self.receipt = QCheckBox("Message Receipt Time")
        self.reason = QLabel()
        self.reason.setWordWrap(True)
        self.scale = _choice(ScaleType, axis.scale.type)
        self.low, self.high = _number(0.0), _number(0.0)
        for name in ("topic", "type", "field", "receipt", "scale", "reason"):
            getattr(self, name).setObjectName(name)
        limits = QHBoxLayout()
        for widget in (self.scale, QLabel("from"), self.low, QLabel("to"), self.high):
            limits.addWidget(widget)
        form = QFormLayout(self)
        for label, item in (
            ("Topic", self.topic),
            ("Type", self.type),
            ("Field", self.field),
            ("", self.receipt),
            ("Scale", limits),
            ("", self.reason),
        ):
            form.addRow(label, item)
        self.topic.currentTextChanged.connect(self._topic_changed)
        self.type.textChanged.connect(lambda _text: self._type_changed())
        self.field.textChanged.connect(lambda _text: self._judge())
        self.receipt.toggled.connect(lambda _on: self._judge())
        self.scale.currentIndexChanged.connect(lambda _index: self._show_limits())
        self.show_axis(axis)

    def show_axis(self, axis: CurveAxis) -> None:
        """Show another configuration."""
        self.axis = copied(axis)
        self.topic.setCurrentText(axis.topic)
        self.type.setText(axis.type or self._types.types.get(axis.topic, ""))
        self.field.setText(axis.field)
        self.receipt.setChecked(axis.field_type == FieldType.RECEIPT_TIME)
        self.scale.setCurrentIndex(self.scale.findData(int(axis.scale.type)))
        self._shown: ScaleType | None = None
        self._show_limits()
        self._type_changed()

    def _show_limits(self) -> None:
        self._keep_limits()
        scale = self.axis.scale
        self._shown = ScaleType(self.scale.currentData())
        prefix = _PREFIXES.get(self._shown)
        for box, end in ((self.low, "minimum"), (self.high, "maximum")):
            box.setEnabled(prefix is not None)
            if prefix:
                box.setValue(getattr(scale, f"{prefix}_{end}"))

    def _keep_limits(self) -> None:
        prefix = _PREFIXES.get(self._shown) if self._shown is not None else None
        if prefix:
            setattr(self.axis.scale, f"{prefix}_minimum", self.low.value())
            setattr(self.axis.scale, f"{prefix}_maximum", self.high.value())

    def _topic_changed(self, topic: str) -> None:
        if topic in self._types.types:
            self.type.setText(self._types.types[topic])

    def _class(self):
        name = self.type.text().strip()
        try:
            return roslib.message.get_message_class(name) if name.count("/") == 1 and all(name.split("/")) else None
        except (ValueError, ImportError):
            return None

    def _type_changed(self) -> None:
        self._fields.setStringList(field_names(self._class()))
        self._judge()

    def _judge(self) -> None:
        """Say what the field leads to."""
        self.field.setDisabled(self.receipt.isChecked())
        message_class, text = self._class(), ""
        if self.type.text() and message_class is None:
            text = f"type {self.type.text()} is not built here"
        elif message_class is not None and self.field.text() and not self.receipt.isChecked():
            try:
                slot = slot_of(message_class, self.field.text())
                if slot.is_array:
                    text = f"an array: go on with an index, as {self.field.text()}/0"
                elif slot.kind in ("text", "message"):
                    text = f"no number but {slot.type}"
            except FieldError as error:
                text = str(error)
        self.reason.setText(text)

    def result(self) -> CurveAxis:
        self._keep_limits()
        axis = self.axis
        axis.topic, axis.type, axis.field = self.topic.currentText().strip(), self.type.text().strip(), self.field.text().strip()
        axis.field_type = FieldType.RECEIPT_TIME if self.receipt.isChecked() else FieldType.DATA
        axis.scale.type = ScaleType(self.scale.currentData())
        return axis


class CurveDialog(QDialog):
    """Configures one curve.

    :param curve: copied; :attr:`curve` is the copy with the changes once the dialog is accepted. :param types: knows the topics.
    """

    def __init__(self, curve: Curve, types, parent=None):
        super().__init__(parent)
        self.curve = copied(curve)
        self.setWindowTitle("Edit Curve")
        self.title = QLineEdit(self.curve.title)
        self.title.setObjectName("title")
        self.x, self.y = AxisBox("X axis", self.curve.axes.x_axis, types), AxisBox("Y axis", self.curve.axes.y_axis, types)
        layout = QVBoxLayout(self)
        first = QFormLayout()
        first.addRow("Title", self.title)
        layout.addLayout(first)
        axes = QHBoxLayout()
        axes.addWidget(self.x)
        axes.addWidget(self.y)
        layout.addLayout(axes)
        layout.addLayout(self._axis_buttons())
        rest = QGridLayout()
        rest.addWidget(self._color_box(), 0, 0)
        rest.addWidget(self._data_box(), 1, 0)
        rest.addWidget(self._style_box(), 0, 1, 2, 1)
        layout.addLayout(rest)
        box = QDialogButtonBox(QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel)
        box.accepted.connect(self.accept)
        box.rejected.connect(self.reject)
        layout.addWidget(box)

    def _axis_buttons(self) -> QHBoxLayout:
        row = QHBoxLayout()
        for text, action in (
            ("Copy X to Y", lambda: self.y.show_axis(self.x.result())),
            ("Copy Y to X", lambda: self.x.show_axis(self.y.result())),
            ("Swap axes", self._swap),
        ):
            button = QPushButton(text)
            button.setAutoDefault(False)
            button.clicked.connect(lambda _checked=False, action=action: action())
            row.addWidget(button)
        row.addStretch()
        return row

    def _swap(self) -> None:
        x, y = copied(self.x.result()), copied(self.y.result())
        self.x.show_axis(y)
        self.y.show_axis(x)

    def _color_box(self) -> QGroupBox:
        box = QGroupBox("Colour")
        row = QHBoxLayout(box)
        self.auto_color = QCheckBox("Auto")
        self.auto_color.setChecked(self.curve.color.type == ColorType.AUTO)
        self.color_button = ColorButton(self.curve.color.custom_color)
        self.color_button.setDisabled(self.auto_color.isChecked())
        self.auto_color.toggled.connect(self.color_button.setDisabled)
        row.addWidget(self.auto_color)
        row.addWidget(self.color_button)
        row.addStretch()
        return box

    def _data_box(self) -> QGroupBox:
        data, box = self.curve.data, QGroupBox("Data")
        form = QFormLayout(box)
        self.data = _choice(DataType, data.type)
        self.capacity, self.frame, self.queue = QSpinBox(), _number(data.time_frame_length), QSpinBox()
        self.capacity.setRange(1, 10_000_000)
        self.capacity.setValue(data.circular_buffer_capacity)
        self.frame.setMinimum(0.0)
        self.frame.setSuffix(" s")
        self.queue.setRange(0, 1_000_000)
        self.queue.setValue(self.curve.subscriber_queue_size)

        def enable() -> None:
            self.capacity.setEnabled(self.data.currentData() == DataType.CIRCULAR_BUFFER)
            self.frame.setEnabled(self.data.currentData() == DataType.TIME_FRAME)

        self.data.currentIndexChanged.connect(lambda _index: enable())
        enable()
        for label, widget in (
            ("Kept as", self.data),
            ("Capacity", self.capacity),
            ("Time frame", self.frame),
            ("Subscriber queue", self.queue),
        ):
            form.addRow(label, widget)
        return box

    def _style_box(self) -> QGroupBox:
        style, box = self.curve.style, QGroupBox("Style")
        form = QFormLayout(box)
        self.style_type, self.pen_style = _choice(StyleType, style.type), _choice(PenStyle, style.pen_style)
        self.interpolate, self.invert, self.antialias = QCheckBox("Interpolate"), QCheckBox("Invert"), QCheckBox("Antialias")
        self.interpolate.setChecked(style.lines_interpolate)
        self.invert.setChecked(style.steps_invert)
        self.antialias.setChecked(style.render_antialias)
        self.orientation, self.baseline = _choice(Orientation, style.sticks_orientation), _number(style.sticks_baseline)
        self.pen_width = QSpinBox()
        self.pen_width.setRange(0, 100)
        self.pen_width.setValue(style.pen_width)
        for label, widget in (
            ("Type", self.style_type),
            ("Lines", self.interpolate),
            ("Sticks", self.orientation),
            ("Baseline", self.baseline),
            ("Steps", self.invert),
            ("Pen", self.pen_style),
            ("Pen width", self.pen_width),
            ("Render", self.antialias),
        ):
            form.addRow(label, widget)
        return box

    def accept(self) -> None:
        curve, style, data = self.curve, self.curve.style, self.curve.data
        curve.title = self.title.text()
        curve.axes.x_axis, curve.axes.y_axis = self.x.result(), self.y.result()
        curve.color.type = ColorType.AUTO if self.auto_color.isChecked() else ColorType.CUSTOM
        curve.color.custom_color = self.color_button.color
        data.type, data.circular_buffer_capacity = DataType(self.data.currentData()), self.capacity.value()
        data.time_frame_length, curve.subscriber_queue_size = self.frame.value(), self.queue.value()
        style.type, style.pen_style = StyleType(self.style_type.currentData()), PenStyle(self.pen_style.currentData())
        style.lines_interpolate, style.steps_invert = self.interpolate.isChecked(), self.invert.isChecked()
        style.render_antialias, style.pen_width = self.antialias.isChecked(), self.pen_width.value()
        style.sticks_orientation = Orientation(self.orientation.currentData())
        style.sticks_baseline = self.baseline.value()
        super().accept()


class ColorButton(QPushButton):
    """Shows a colour; a click chooses another."""

    def __init__(self, color: str, on_change=lambda color: None):
        super().__init__()
        self._on_change = on_change
        self.setAutoDefault(False)
        self.setFixedWidth(48)
        self.set_color(color)
        self.clicked.connect(lambda: self._choose())

    def set_color(self, color: str) -> None:
        self.color = color
        self.setStyleSheet(f"background-color: {QColor(color).name()}")

    def _choose(self) -> None:
        chosen = QColorDialog.getColor(QColor(self.color), self)
        if chosen.isValid():
            self.set_color(chosen.name())
            self._on_change(chosen.name())
