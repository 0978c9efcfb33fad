"""Robot poses: named joint values of a group."""

from __future__ import annotations

import math
from typing import Any

from python_qt_binding.QtCore import Qt, QTimer
from python_qt_binding.QtWidgets import QDoubleSpinBox, QHBoxLayout, QPushButton, QScrollArea, QSlider, QVBoxLayout, QWidget
from srdfdom import srdf

from moveit_setup_assistant.screens.base import Screen, Table, allow, choice, form_layout, hint, line

_STEPS = 1000  # of a slider


class PosesScreen(Screen):
    """The table of poses, and for the marked one a slider for each joint; the robot in the picture follows."""

    title = "Robot Poses"
    about = "Poses with names, such as home: MoveIt plans to them by name, and simulation begins in the first one of each group."

    def __init__(self, session) -> None:
        super().__init__(session)
        self._sliders: dict[str, tuple] = {}
        self._state: Any = None  # of motion, from enter() on
        row = QHBoxLayout()
        row.addLayout(self._left(), 1)
        row.addLayout(self._right(), 1)
        self.layout_.addLayout(row)
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._next)

    def _left(self) -> QVBoxLayout:
        left = QVBoxLayout()
        self._list = Table("poses_list", ("Pose", "Group"))
        self._list.itemSelectionChanged.connect(self._show)
        left.addWidget(self._list)
        self._buttons = {}
        for text, name, action in (
            ("&Add Pose", "add", self._add),
            ("&Change", "change", self._change),
            ("&Delete", "delete", self._remove),
            ("&Show Default Pose", "default", self._default),
            ("&MoveIt!", "animate", self._animate),
        ):
            button = self._buttons[name] = QPushButton(text)
            button.setObjectName(f"poses_{name}")
            button.clicked.connect(action)
            left.addWidget(button)
        self._buttons["animate"].setCheckable(True)
        return left

    def _right(self) -> QVBoxLayout:
        right = QVBoxLayout()
        self._name, self._group = line(), choice()
        self._name.setObjectName("poses_name")
        self._group.setObjectName("poses_group")
        self._name.textChanged.connect(self._allow)
        self._group.currentTextChanged.connect(self._make_sliders)
        form = form_layout()
        form.setRowWrapPolicy(form.WrapAllRows)
        form.addRow("Pose name", self._name)
        form.addRow("Planning group", self._group)
        right.addLayout(form)
        self._area = QScrollArea()
        self._area.setWidgetResizable(True)
        right.addWidget(self._area)
        self._why, self._touching = hint("poses_hint"), hint("poses_collision", "#a00000")
        right.addWidget(self._why)
        right.addWidget(self._touching)
        return right

    def enter(self) -> None:
        self._state = self.session.model().state()
        self._group.clear()
        self._group.addItems([group.name for group in self.config.semantics.groups])
        self._fill(-1)

    def leave(self):
        self._stop()
        return None

    def _fill(self, row: int) -> None:
        self._list.show_rows([(state.name, state.group) for state in self.config.semantics.group_states], row)
        self._allow()

    def _marked(self):
        row, poses = self._list.row(), self.config.semantics.group_states
        return poses[row] if 0 <= row < len(poses) else None

    def _refused(self, pose) -> str:
        """Why the form cannot become this pose, or a new one (None); "" if it can."""
        name, group = self._name.text().strip(), self._group.currentText()
        if not group:
            return "A pose belongs to a group: make the group first, on the screen Planning Groups."
        if not self._sliders:
            return f"Group '{group}' moves no joint that a pose could hold."
        if not name:
            return "A pose needs a name."
        if any(p.name == name and p.group == group and p is not pose for p in self.config.semantics.group_states):
            return f"Group '{group}' has a pose '{name}' already; choose another name, or change that one."
        return ""

    def _is_same(self, pose) -> bool:
        held = {joint.name: round(joint.value[0], 4) for joint in pose.joints if joint.value}
        shown = {joint.name: joint.value[0] for joint in self._values()}
        return (pose.name, pose.group, held) == (self._name.text().strip(), self._group.currentText(), shown)

    def _allow(self, *_) -> None:
        """Enable what can be done now."""
        marked, new = self._marked(), self._refused(None)
        same = marked is not None and self._is_same(marked)
        other = self._refused(marked) if marked is not None else "Mark a pose in the table first."
        allow(self._buttons["add"], new)
        allow(self._buttons["change"], "Nothing is changed yet." if same else other)
        allow(self._buttons["delete"], "" if marked is not None else other)
        allow(self._buttons["animate"], "" if self.config.semantics.group_states else "Add a pose first.")
        self._why.setText(new if marked is None else other)

    def _make_sliders(self, group: str) -> None:
        model = self.session.model()
        page = QWidget()
        form = form_layout(page)
        form.setRowWrapPolicy(form.WrapAllRows)
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
        self._touching.setText("The robot touches itself: " + ", ".join(f"{a} - {b}" for a, b in touching) if touching else "")
        self.session.highlight([name for pair in touching for name in pair])
        self._allow()

    def _set(self, values: dict[str, float]) -> None:
        for name, value in values.items():
            self._state.set(name, value)
            if name in self._sliders:
                self._sliders[name][1].setValue(value)
        self._look()

    def _show(self) -> None:
        pose = self._marked()
        if pose is not None:
            self._name.setText(pose.name)
            self._group.setCurrentText(pose.group)
            self._set({joint.name: joint.value[0] for joint in pose.joints if joint.value and self._is_single(joint.name)})
        self._allow()

    def _is_single(self, joint: str) -> bool:
        return self.session.model().has_joint(joint) and len(self.session.model().joint(joint).variables) == 1

    def _values(self):
        return [srdf.JointVal(name, [round(self._sliders[name][1].value(), 4)]) for name in self._sliders]

    def _add(self) -> None:
        pose = srdf.GroupState()
        self._write(pose)
        self.config.semantics.add_group_state(pose)
        self._fill(len(self.config.semantics.group_states) - 1)

    def _change(self) -> None:
        self._write(self._marked())
        self._fill(self._list.row())

    def _write(self, pose) -> None:
        pose.name, pose.group, pose.joints = self._name.text().strip(), self._group.currentText(), self._values()

    def _remove(self) -> None:
        row = self._list.row()
        del self.config.semantics.group_states[row]
        self._fill(min(row, len(self.config.semantics.group_states) - 1))

    def _default(self) -> None:
        default = self.session.model().state()
        self._set({name: default.get(name) for name in self.config.robot.movable_joints if self._is_single(name)})

    def _animate(self) -> None:
        """Show one pose after the other, a second each, until the button is pressed again."""
        if self._timer.isActive():
            self._stop()
        else:
            self._next()
            self._timer.start(1000)

    def _stop(self) -> None:
        self._timer.stop()
        self._buttons["animate"].setChecked(False)

    def _next(self) -> None:
        count = len(self.config.semantics.group_states)
        if count:
            self._list.selectRow((self._list.row() + 1) % count)
        else:
            self._stop()
