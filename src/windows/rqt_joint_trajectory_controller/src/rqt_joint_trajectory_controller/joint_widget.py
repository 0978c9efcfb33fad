"""One joint: a slider and a number."""

from python_qt_binding.QtCore import Qt, Signal
from python_qt_binding.QtWidgets import QDoubleSpinBox, QHBoxLayout, QSlider, QWidget

_STEPS = 100


class JointWidget(QWidget):
    """``value()`` is what is shown; ``moved`` tells that the user has changed it."""

    moved = Signal()

    def __init__(self, name: str, lowest: float, highest: float):
        super().__init__()
        self._lowest, self._highest = lowest, highest
        self.slider, self.spin_box = QSlider(Qt.Orientation.Horizontal), QDoubleSpinBox()
        self.slider.setObjectName(f"{name}_slider")
        self.spin_box.setObjectName(f"{name}_spin_box")
        self.slider.setRange(0, _STEPS)
        self.spin_box.setDecimals(6)
        self.spin_box.setRange(lowest, highest)
        self.spin_box.setSingleStep((highest - lowest) / _STEPS)
        self.spin_box.setKeyboardTracking(False)
        layout = QHBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.slider, 1)
        layout.addWidget(self.spin_box)
        self.slider.valueChanged.connect(self._slid)
        self.spin_box.valueChanged.connect(self._typed)

    def value(self) -> float:
        return self.spin_box.value()

    def show_value(self, value: float) -> None:
        """Without telling that it was moved."""
        for widget in (self.slider, self.spin_box):
            widget.blockSignals(True)
        self.spin_box.setValue(value)
        self.slider.setValue(self._place(value))
        for widget in (self.slider, self.spin_box):
            widget.blockSignals(False)

    def _place(self, value: float) -> int:
        share = (min(max(value, self._lowest), self._highest) - self._lowest) / (self._highest - self._lowest)
        return round(_STEPS * share) if share == share else 0

    def _slid(self, place: int) -> None:
        self.spin_box.setValue(self._lowest + (self._highest - self._lowest) * place / _STEPS)

    def _typed(self, value: float) -> None:
        blocked = self.slider.blockSignals(True)
        self.slider.setValue(self._place(value))
        self.slider.blockSignals(blocked)
        self.moved.emit()
