"""Robot poses: named joint values of a group."""

from __future__ import annotations

import math
from typing import Any

from python_qt_binding.QtCore import Qt, QTimer
from python_qt_binding.QtWidgets import (
    QDoubleSpinBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QListWidget,
    QPushButton,
    QScrollArea,
    QSlider,
    QVBoxLayout,
    QWidget,
)
from srdfdom import srdf

from moveit_setup_assistant.screens.base import Screen, choice, line

_STEPS = 1000  # of a slider


class PosesScreen(Screen):
    """The list of poses, and for the marked one a slider for each joint; the robot in the picture follows."""

    title = "Robot Poses"
    about = "Poses with names, such as home: MoveIt plans to them by name, and simulation begins in the first one of each group."

    def __init__(self, session) -> None:
        super().__init__(session)
        self._sliders: dict[str, tuple] = {}
        self._state: Any = None  # of motion, from enter() on
        row = QHBoxLayout()
        left, right = QVBoxLayout(), QVBoxLayout()
        self._list = QListWidget()
        self._list.setObjectName("poses_list")
        self._list.currentRowChanged.connect(self._show)
        left.addWidget(self._list)
        for text, name, action in (
            ("Add Pose", "add", self._add),
            ("Change", "change", self._change),
            ("Delete", "delete", self._remove),
            ("Show Default Pose", "default", self._default),
            ("MoveIt!", "animate", self._animate),
        ):
            button = QPushButton(text)
            button.setObjectName(f"poses_{name}")
            button.clicked.connect(action)
            left.addWidget(button)
        self._name, self._group = line(), choice()
        self._name.setObjectName("poses_name")
        self._group.setObjectName("poses_group")
        self._group.currentTextChanged.connect(self._make_sliders)
        form = QFormLayout()
        form.addRow("Pose name", self._name)
        form.addRow("Planning group", self._group)
        right.addLayout(form)
        self._area = QScrollArea()
        self._area.setWidgetResizable(True)
        right.addWidget(self._area)
        self._hint = QLabel()
        self._hint.setObjectName("poses_collision")
        right.addWidget(self._hint)
        row.addLayout(left, 1)
        row.addLayout(right, 2)
        self.layout_.addLayout(row)
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._next)

    def enter(self) -> None:
        self._state = self.session.model().state()
        self._group.clear()
        self._group.addItems([group.name for group in self.config.semantics.groups])
        self._fill(-1)

    def leave(self):
        self._timer.stop()
        return None

    def _fill(self, row: int) -> None:
        self._list.clear()
        self._list.addItems([f"{state.name} ({state.group})" for state in self.config.semantics.group_states])
        self._list.setCurrentRow(row)

    def _make_sliders(self, group: str) -> None:
        model = self.session.model()
        page = QWidget()
        form = QFormLayout(page)
        self._sliders = {}
        joints = [
            name for name in (model.group(group).active_joints if model.has_group(group) else ()) if len(model.joint(name).variables) == 1
        ]
        for name in joints:
            limits = model.joint(name).limits[0]
            low, high = (limits.min_position, limits.max_position) if limits.has_position else (-math.pi, math.pi)
            slider, box = QSlider(Qt.Horizontal), QDoubleSpinBox()
            slider.setRange(0, _STEPS)
            box.setDecimals(4)
            box.setRange(low, high)
            box.setSingleStep(0.01)
            box.setObjectName(f"poses_value_{name}")
            slider.setObjectName(f"poses_slider_{name}")
            box.setValue(self._state.get(name))
            slider.setValue(round(_STEPS * (self._state.get(name) - low) / ((high - low) or 1)))
            slider.valueChanged.connect(lambda v, box=box, low=low, high=high: box.setValue(low + (high - low) * v / _STEPS))
            box.valueChanged.connect(lambda v, name=name, slider=slider, low=low, high=high: self._moved(name, v, slider, low, high))
            self._sliders[name] = (slider, box)
            row = QHBoxLayout()
            row.addWidget(slider)
            row.addWidget(box)
            form.addRow(name, row)
        self._area.setWidget(page)
        self._look()

    def _moved(self, joint: str, value: float, slider: QSlider, low: float, high: float) -> None:
        slider.blockSignals(True)
        slider.setValue(round(_STEPS * (value - low) / ((high - low) or 1)))
        slider.blockSignals(False)
        self._state.set(joint, value)
        self._look()

    def _look(self) -> None:
        self.session.show_state(self._state)
        touching = self.session.collisions(self._state)
        self._hint.setText("The robot touches itself: " + ", ".join(f"{a} - {b}" for a, b in touching) if touching else "")
        self.session.highlight([name for pair in touching for name in pair])

    def _set(self, values: dict[str, float]) -> None:
        for name, value in values.items():
            self._state.set(name, value)
            if name in self._sliders:
                self._sliders[name][1].setValue(value)
        self._look()

    def _show(self, row: int) -> None:
        poses = self.config.semantics.group_states
        if 0 <= row < len(poses):
            self._name.setText(poses[row].name)
            self._group.setCurrentText(poses[row].group)
            self._set({joint.name: joint.value[0] for joint in poses[row].joints if joint.value and self._is_single(joint.name)})

    def _is_single(self, joint: str) -> bool:
        return self.session.model().has_joint(joint) and len(self.session.model().joint(joint).variables) == 1

    def _values(self):
        return [srdf.JointVal(name, [round(self._sliders[name][1].value(), 4)]) for name in self._sliders]

    def _add(self) -> None:
        self._write(srdf.GroupState())

    def _change(self) -> None:
        row = self._list.currentRow()
        if row >= 0:
            self._write(self.config.semantics.group_states[row])

    def _write(self, pose) -> None:
        name, group = self._name.text().strip(), self._group.currentText()
        poses = self.config.semantics.group_states
        if not name or not group:
            self.session.say("A pose needs a name and a group; make the group first, on the screen Planning Groups.", bad=True)
            return
        if any(p.name == name and p.group == group and p is not pose for p in poses):
            self.session.say(f"Group '{group}' has a pose '{name}' already; choose another name, or Change that one.", bad=True)
            return
        pose.name, pose.group, pose.joints = name, group, self._values()
        if pose not in poses:
            self.config.semantics.add_group_state(pose)
        self._fill(poses.index(pose))

    def _remove(self) -> None:
        row = self._list.currentRow()
        if row >= 0:
            del self.config.semantics.group_states[row]
            self._fill(min(row, len(self.config.semantics.group_states) - 1))

    def _default(self) -> None:
        default = self.session.model().state()
        self._set({name: default.get(name) for name in self.config.robot.movable_joints if self._is_single(name)})

    def _animate(self) -> None:
        """Show one pose after the other, a second each."""
        if self._timer.isActive():
            self._timer.stop()
        elif self.config.semantics.group_states:
            self._next()
            self._timer.start(1000)

    def _next(self) -> None:
        count = len(self.config.semantics.group_states)
        self._list.setCurrentRow((self._list.currentRow() + 1) % count if count else -1)
