"""Editors of single parameters."""

import ast
import math
from collections.abc import Callable
from typing import Any

from python_qt_binding.QtCore import Qt, Signal
from python_qt_binding.QtWidgets import QCheckBox, QComboBox, QHBoxLayout, QLabel, QLineEdit, QMenu, QSlider, QWidget

_STEPS = 100  # of a slider of real numbers
_INT = 2**31 - 1


class Editor(QWidget):
    """A parameter's value. ``changed`` tells that the user has set another one."""

    changed = Signal(str, object)

    def __init__(self, description: dict):
        """:param description: name, type, description, min, max, default, edit_method"""
        super().__init__()
        self.name, self.description = description["name"], description
        self.setObjectName(self.name)
        self.setToolTip(description.get("description", ""))
        self.value: Any = description.get("default")
        row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        self.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.customContextMenuRequested.connect(lambda place: self.menu().popup(self.mapToGlobal(place)))

    def show_value(self, value: Any) -> None:
        """The server has this value now."""
        self.value = value
        self._display(value)

    def choose(self, value: Any) -> None:
        """The user has chosen this value."""
        self.show_value(value)
        self.changed.emit(self.name, value)

    def menu(self) -> QMenu:
        menu = QMenu(self)
        for label, value in self.menu_values():
            menu.addAction(label, lambda value=value: self.choose(value))
        return menu

    def menu_values(self) -> list[tuple[str, Any]]:
        return [(f"Set to Default ({self.description['default']})", self.description["default"])]

    def _display(self, value: Any) -> None:
        raise NotImplementedError

    def label(self) -> str | None:
        """The text beside it; None for editors that have one of their own."""
        return self.name


class BooleanEditor(Editor):
    def __init__(self, description):
        super().__init__(description)
        self.check_box = QCheckBox()
        self.layout().addWidget(self.check_box)
        self.layout().addStretch()
        self.check_box.clicked.connect(lambda on: self.choose(bool(on)))

    def _display(self, value):
        self.check_box.setChecked(bool(value))


class StringEditor(Editor):
    def __init__(self, description):
        super().__init__(description)
        self.line_edit = QLineEdit()
        self.layout().addWidget(self.line_edit)
        self.line_edit.editingFinished.connect(self._finished)

    def _finished(self):
        if self.line_edit.text() != self.value:
            self.choose(self.line_edit.text())

    def _display(self, value):
        if self.line_edit.text() != str(value):
            self.line_edit.setText(str(value))

    def menu_values(self):
        return super().menu_values() + [("Set to Empty String", "")]


class NumberEditor(Editor):
    """A slider with the bounds at its ends, and a text."""

    kind: Callable[[Any], float] = float

    def __init__(self, description):
        super().__init__(description)
        self.lowest, self.highest = self.kind(description["min"]), self.kind(description["max"])
        self.slider, self.line_edit = QSlider(Qt.Orientation.Horizontal), QLineEdit()
        self.line_edit.setMaximumWidth(100)
        for widget, stretch in (
            (QLabel(self._text(self.lowest)), 0),
            (self.slider, 1),
            (QLabel(self._text(self.highest)), 0),
            (self.line_edit, 0),
        ):
            self.layout().addWidget(widget, stretch)
        self.slider.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.slider.wheelEvent = lambda event: event.ignore()  # scrolling past must not set anything
        self._prepare_slider()
        self.slider.valueChanged.connect(self._slid)
        self.slider.sliderReleased.connect(self._send_slider)
        self.line_edit.editingFinished.connect(self._typed)

    def _prepare_slider(self):
        raise NotImplementedError

    def _slid(self, place):
        value = self._value_at(place)
        self.line_edit.setText(self._text(value))
        if not self.slider.isSliderDown():
            self._send_slider()

    def _send_slider(self):
        value = self._value_at(self.slider.value())
        if value != self.value:
            self.value = value
            self.changed.emit(self.name, value)

    def _typed(self):
        text = self.line_edit.text().strip()
        try:
            value = self.kind(text)
        except ValueError:
            self._display(self.value)
            return
        value = value if math.isnan(value) else min(max(value, self.lowest), self.highest)
        if value != self.value and not (isinstance(self.value, float) and math.isnan(value) and math.isnan(self.value)):
            self.choose(value)
        else:
            self._display(self.value)

    def _display(self, value):
        blocked = self.slider.blockSignals(True)
        if not self.slider.isSliderDown():
            self.slider.setValue(self._place_of(value))
            if not self.line_edit.hasFocus() or not self.line_edit.isModified():
                self.line_edit.setText(self._text(value))
        self.slider.blockSignals(blocked)

    def menu_values(self):
        return super().menu_values() + [
            (f"Set to Minimum ({self._text(self.lowest)})", self.lowest),
            (f"Set to Maximum ({self._text(self.highest)})", self.highest),
        ]

    @staticmethod
    def _text(value) -> str:
        return str(value)


class IntegerEditor(NumberEditor):
    kind = int

    def _prepare_slider(self):
        self.slider.setRange(max(self.lowest, -_INT), min(self.highest, _INT))
        self.slider.setPageStep(max(1, min(_INT, (self.highest - self.lowest) // 10)))

    def _value_at(self, place):
        return place

    def _place_of(self, value):
        return int(min(max(value, -_INT), _INT))


class DoubleEditor(NumberEditor):
    """A side without a bound is reached by an arc tangent."""

    def _prepare_slider(self):
        self.slider.setRange(0, _STEPS)
        bounds = [math.isfinite(bound) and abs(bound) < 1e300 for bound in (self.lowest, self.highest)]
        if all(bounds):
            self._to = lambda value: value
            self._from = lambda number: number
        else:
            offset = self.lowest if bounds[0] else self.highest if bounds[1] else 0.0
            self._to = lambda value: math.atan(value - offset)
            self._from = lambda number: math.tan(number) + offset
        self._first = self._to(self.lowest) if bounds[0] else -math.pi / 2
        self._last = self._to(self.highest) if bounds[1] else math.pi / 2
        self.slider.setEnabled(self._last > self._first)

    def _value_at(self, place):
        if place in (0, _STEPS):
            return self.highest if place else self.lowest
        return self._from(self._first + (self._last - self._first) * place / _STEPS)

    def _place_of(self, value):
        if math.isnan(value) or self._last <= self._first:
            return 0
        share = (self._to(min(max(value, self.lowest), self.highest)) - self._first) / (self._last - self._first)
        return round(_STEPS * share)

    def menu_values(self):
        return super().menu_values() + [("Set to NaN", math.nan)]

    @staticmethod
    def _text(value) -> str:
        return f"{value:g}" if float(f"{value:g}") == value else repr(value)


class EnumEditor(Editor):
    def __init__(self, description, choices):
        """:param choices: (name, value, description) each"""
        super().__init__(description)
        self.combo_box, self._choices = QComboBox(), choices
        self.combo_box.wheelEvent = lambda event: event.ignore()
        for index, (name, value, tip) in enumerate(choices):
            self.combo_box.addItem(f"{name} ({value})")
            self.combo_box.setItemData(index, tip, Qt.ItemDataRole.ToolTipRole)
        self.layout().addWidget(self.combo_box)
        self.combo_box.activated.connect(lambda index: self.choose(self._choices[index][1]))

    def _display(self, value):
        self.combo_box.setCurrentIndex(next((n for n, choice in enumerate(self._choices) if choice[1] == value), -1))


_KINDS = {"bool": BooleanEditor, "str": StringEditor, "int": IntegerEditor, "double": DoubleEditor}


def make_editor(description: dict) -> Editor | None:
    """The editor for a parameter; None for types that nobody knows."""
    choices = _choices(description.get("edit_method", ""))
    if choices:
        return EnumEditor(description, choices)
    kind = _KINDS.get(description.get("type", ""))
    return kind(description) if kind else None


def _choices(edit_method: str) -> list:
    """A server describes them as a Python literal."""
    try:
        return [(entry["name"], entry["value"], entry.get("description", "")) for entry in ast.literal_eval(edit_method)["enum"]]
    except (ValueError, SyntaxError, KeyError, TypeError, AttributeError):
        return []
