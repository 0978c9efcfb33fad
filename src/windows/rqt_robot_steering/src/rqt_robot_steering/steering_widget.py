"""Two sliders, their limits, and the keys."""

from python_qt_binding.QtCore import Qt, Signal
from python_qt_binding.QtGui import QKeySequence
from python_qt_binding.QtWidgets import QDoubleSpinBox, QGridLayout, QHBoxLayout, QLabel, QLineEdit, QPushButton, QSlider, QWidget
from qt_gui.application.compatibility import QShortcut

_SCALE = 1000  # slider units for 1 m/s or rad/s
_STEP = 10  # slider units for a key; ten times that with Shift
#: Name in settings and parameters: (value, axis, whether it is the upper limit).
LIMITS = {"vx_max": (1.0, "x", True), "vx_min": (-1.0, "x", False), "vw_max": (3.0, "w", True), "vw_min": (-3.0, "w", False)}
#: Key: (axis, steps); 0 steps put it to zero.
KEYS = {"W": ("x", 1), "S": ("x", -1), "X": ("x", 0), "A": ("w", 1), "D": ("w", -1), "Z": ("w", 0)}


class SteeringWidget(QWidget):
    topic_changed = Signal(str)
    stopped = Signal()

    def __init__(self):
        super().__init__()
        self.setObjectName("RobotSteeringWidget")
        self.setWindowTitle("Robot Steering")
        self.topic_line_edit = QLineEdit("/cmd_vel")
        self.topic_line_edit.setObjectName("topic_line_edit")
        self.topic_line_edit.editingFinished.connect(lambda: self.topic_changed.emit(self.topic_line_edit.text()))
        self.stop_button = self._button("stop_push_button", "Stop", self.stop)
        self.sliders, self.labels, self.limits = {}, {}, {}
        for axis, name, direction in (
            ("x", "x_linear_slider", Qt.Orientation.Vertical),
            ("w", "z_angular_slider", Qt.Orientation.Horizontal),
        ):
            slider, label = QSlider(direction), QLabel()
            slider.setObjectName(name)
            slider.setTickPosition(QSlider.TickPosition.TicksBothSides)
            slider.setTickInterval(_SCALE)
            slider.valueChanged.connect(lambda value, axis=axis: self._show(axis))
            label.setObjectName(f"current_{axis}_label")
            self.sliders[axis], self.labels[axis] = slider, label
        self.sliders["w"].setInvertedAppearance(True)  # left turns left
        for name, (value, axis, _upper) in LIMITS.items():
            box = QDoubleSpinBox()
            box.setObjectName(f"{name}_spin_box")
            box.setRange(-10, 10)
            box.setSingleStep(0.1)
            box.valueChanged.connect(lambda _, axis=axis: self._set_range(axis))
            self.limits[name] = box
            box.setValue(value)
        self._arrange()
        for axis in self.sliders:
            self._set_range(axis)
            self._show(axis)
        for key, (axis, steps) in KEYS.items():  # wherever the focus is; fields of text keep their keys
            for prefix, factor in (("", 1), ("Shift+", 10)):
                shortcut = QShortcut(QKeySequence(prefix + key), self)
                shortcut.setContext(Qt.ShortcutContext.ApplicationShortcut)
                shortcut.activated.connect(lambda axis=axis, steps=steps * factor: self.move_by(axis, steps))
        for key in ("Space", "Shift+Space"):
            shortcut = QShortcut(QKeySequence(key), self)
            shortcut.setContext(Qt.ShortcutContext.ApplicationShortcut)
            shortcut.activated.connect(self.stop)
            shortcut.activatedAmbiguously.connect(self.stop)  # of two such windows
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)

    def _button(self, name: str, text: str, call) -> QPushButton:
        button = QPushButton(text)
        button.setObjectName(name)
        button.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # the space bar belongs to Stop
        button.clicked.connect(lambda: call())
        return button

    def _arrange(self) -> None:
        grid = QGridLayout(self)
        top = QHBoxLayout()
        top.addWidget(self.topic_line_edit)
        top.addWidget(self.stop_button)
        grid.addLayout(top, 0, 0, 1, 3)
        grid.addWidget(self.limits["vx_max"], 1, 0)
        grid.addWidget(self.sliders["x"], 1, 1, 3, 1, Qt.AlignmentFlag.AlignHCenter)
        grid.addWidget(self.labels["x"], 2, 0)
        grid.addWidget(self.limits["vx_min"], 3, 0)
        steps = QGridLayout()
        for row, (name, text, move) in enumerate(
            (("increase_x_linear_push_button", "+", 1), ("reset_x_linear_push_button", "0", 0), ("decrease_x_linear_push_button", "-", -1))
        ):
            steps.addWidget(self._button(name, text, lambda move=move: self.move_by("x", move * 10)), row, 0)
        grid.addLayout(steps, 1, 2, 3, 1)
        grid.addWidget(self.sliders["w"], 4, 0, 1, 3)
        low = QHBoxLayout()
        low.addWidget(self.limits["vw_max"])
        for name, text, move in (
            ("increase_z_angular_push_button", "<", 1),
            ("reset_z_angular_push_button", "0", 0),
            ("decrease_z_angular_push_button", ">", -1),
        ):
            low.addWidget(self._button(name, text, lambda move=move: self.move_by("w", move * 10)))
        low.addWidget(self.limits["vw_min"])
        grid.addLayout(low, 5, 0, 1, 3)
        grid.addWidget(self.labels["w"], 6, 0, 1, 3, Qt.AlignmentFlag.AlignHCenter)
        grid.setRowStretch(2, 1)

    def velocities(self) -> tuple:
        """(m/s ahead, rad/s to the left)"""
        return self.sliders["x"].value() / _SCALE, self.sliders["w"].value() / _SCALE

    def move_by(self, axis: str, steps: int) -> None:
        """Move the slider of ``axis``, ``x`` or ``w``, by ``steps`` of 0.01 (m/s, rad/s); 0 sets it to zero."""
        slider = self.sliders[axis]
        slider.setValue(slider.value() + steps * _STEP if steps else 0)

    def stop(self) -> None:
        for slider in self.sliders.values():
            slider.setValue(0)
        self.stopped.emit()

    def mark_topic(self, legal: bool) -> None:
        self.topic_line_edit.setStyleSheet("" if legal else "color: red")
        self.topic_line_edit.setToolTip("" if legal else "This is no name for a topic: letters, digits, _ and / only.")

    def _set_range(self, axis: str) -> None:
        if all(name in self.limits for name in LIMITS):
            bounds = sorted(self.limits[name].value() for name, limit in LIMITS.items() if limit[1] == axis)
            self.sliders[axis].setRange(round(bounds[0] * _SCALE), round(bounds[1] * _SCALE))

    def _show(self, axis: str) -> None:
        unit = "m/s" if axis == "x" else "rad/s"
        self.labels[axis].setText(f"{self.sliders[axis].value() / _SCALE:0.2f} {unit}")
