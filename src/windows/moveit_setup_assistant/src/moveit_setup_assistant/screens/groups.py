"""Planning groups: joints that are planned for together."""

from __future__ import annotations

from python_qt_binding.QtWidgets import QDoubleSpinBox, QFormLayout, QHBoxLayout, QListWidget, QPushButton, QTabWidget, QVBoxLayout, QWidget
from srdfdom import srdf

from moveit_setup_assistant import planners
from moveit_setup_assistant.configuration import SOLVERS, Kinematics
from moveit_setup_assistant.screens.base import Screen, TwoLists, choice, line

_NUMBERS = (
    ("search_resolution", "Kin. search resolution"),
    ("timeout", "Kin. search timeout (s)"),
    ("goal_joint_tolerance", "Goal joint tolerance"),
    ("goal_position_tolerance", "Goal position tolerance (m)"),
    ("goal_orientation_tolerance", "Goal orientation tolerance (rad)"),
)


class GroupsScreen(Screen):
    """The list of groups, and for the marked one its solver, planner and members."""

    title = "Planning Groups"
    about = (
        "A planning group is an arm, a gripper, or both: joints that are planned for together. Most arms are one chain from their "
        "base to the link that is moved to poses."
    )

    def __init__(self, session) -> None:
        super().__init__(session)
        self._group = None
        row = QHBoxLayout()
        self._list = QListWidget()
        self._list.setObjectName("groups_list")
        self._list.setMaximumWidth(160)
        self._list.currentRowChanged.connect(self._choose)
        left = QVBoxLayout()
        left.addWidget(self._list)
        for text, name, action in (("Add Group", "add", self._add), ("Delete Group", "delete", self._remove)):
            button = QPushButton(text)
            button.setObjectName(f"groups_{name}")
            button.clicked.connect(action)
            left.addWidget(button)
        row.addLayout(left)
        self._right = QWidget()
        right = QVBoxLayout(self._right)
        right.addLayout(self._settings())
        right.addWidget(self._members())
        row.addWidget(self._right, 1)
        self.layout_.addLayout(row)

    def _settings(self) -> QFormLayout:
        form = QFormLayout()
        self._name, self._solver = line(), choice(("None", *SOLVERS), editable=True)
        self._planner, self._file = choice(("None", *planners.names())), line()
        self._numbers = {}
        form.addRow("Group name", self._name)
        form.addRow("Kinematic solver", self._solver)
        for key, text in _NUMBERS:
            box = self._numbers[key] = QDoubleSpinBox()
            box.setDecimals(5)
            box.setRange(0, 1000)
            box.setSingleStep(0.005)
            box.setObjectName(f"groups_{key}")
            form.addRow(text, box)
        form.addRow("Kin. parameters file", self._file)
        form.addRow("Group default planner", self._planner)
        for widget, name in ((self._name, "name"), (self._solver, "solver"), (self._planner, "planner"), (self._file, "file")):
            widget.setObjectName(f"groups_{name}")
        self._name.editingFinished.connect(self._rename)
        return form

    def _members(self) -> QTabWidget:
        self._lists = {
            kind: TwoLists(f"Available {kind}", f"{kind.capitalize()} of the group", f"groups_{kind}")
            for kind in ("joints", "links", "subgroups")
        }
        self._base, self._tip = choice(), choice()
        self._base.setObjectName("groups_base_link")
        self._tip.setObjectName("groups_tip_link")
        chain = QWidget()
        form = QFormLayout(chain)
        form.addRow("Base link", self._base)
        form.addRow("Tip link", self._tip)
        tabs = QTabWidget()
        tabs.setObjectName("groups_members")
        tabs.addTab(chain, "Kin. Chain")
        for kind, lists in self._lists.items():
            tabs.addTab(lists, kind.capitalize())
            lists.changed.connect(self._take)
        for kind in ("joints", "links"):
            self._lists[kind].looked_at.connect(
                lambda names, kind=kind: self.session.highlight(names if kind == "links" else [self.session.child_of(n) for n in names])
            )
        for box in (self._base, self._tip):
            box.activated.connect(lambda _index: self._take())
        return tabs

    def enter(self) -> None:
        for box in (self._base, self._tip):
            box.clear()
            box.addItems(["", *self.config.robot.model.links])
        self._fill(0 if self.config.semantics.groups else -1)

    def leave(self):
        self._take()
        return None

    def _fill(self, row: int) -> None:
        self._group = None
        self._list.clear()
        self._list.addItems([group.name for group in self.config.semantics.groups])
        self._list.setCurrentRow(row)
        self._right.setEnabled(row >= 0)

    def _choose(self, row: int) -> None:
        self._take()
        groups = self.config.semantics.groups
        self._group = groups[row] if 0 <= row < len(groups) else None
        if self._group is None:
            return
        group, model = self._group, self.config.robot.model
        solved = self.config.kinematics.get(group.name) or Kinematics()
        self._name.setText(group.name)
        self._solver.setCurrentText(solved.solver or "None")
        for key, box in self._numbers.items():
            box.setValue(float(getattr(solved, key)))
        self._file.setText(solved.parameters_file)
        self._planner.setCurrentText(self.config.default_planners.get(group.name) or "None")
        chain = group.chains[0] if group.chains else srdf.Chain("", "")
        self._base.setCurrentText(chain.base_link)
        self._tip.setCurrentText(chain.tip_link)
        self._lists["joints"].set(model.joints, [joint.name for joint in group.joints])
        self._lists["links"].set(model.links, [link.name for link in group.links])
        self._lists["subgroups"].set([g.name for g in groups if g is not group], [g.name for g in group.groups])
        self.session.highlight(self.session.links_of(group.name))

    def _take(self) -> None:
        """Put what the form says into the group that it shows."""
        group = self._group
        if group is None:
            return
        group.joints = [srdf.Joint(name) for name in self._lists["joints"].chosen()]
        group.links = [srdf.Link(name) for name in self._lists["links"].chosen()]
        group.groups[:] = [srdf.Group(name) for name in self._lists["subgroups"].chosen()]
        others: list = group.chains[1:]
        base, tip = self._base.currentText(), self._tip.currentText()
        group.chains = ([srdf.Chain(base, tip)] if base and tip else []) + others
        solver = self._solver.currentText().strip()
        if solver in ("", "None"):
            self.config.kinematics.pop(group.name, None)
        else:
            solved = self.config.kinematics.setdefault(group.name, Kinematics())
            solved.solver, solved.parameters_file = solver, self._file.text().strip()
            for key, box in self._numbers.items():
                setattr(solved, key, box.value())
        planner = self._planner.currentText()
        self.config.default_planners.pop(group.name, None)
        if planner != "None":
            self.config.default_planners[group.name] = planner
        self.session.model_changed()
        self.session.highlight(self.session.links_of(group.name))

    def _rename(self) -> None:
        group, name = self._group, self._name.text().strip()
        if group is None or name == group.name:
            return
        if not name or any(c.isspace() for c in name) or any(g.name == name for g in self.config.semantics.groups):
            self.session.say(f"'{name}' cannot be a group's name: it is empty, has blanks, or is taken.", bad=True)
            self._name.setText(group.name)
            return
        self.session.rename_group(group, name)
        self._list.currentItem().setText(name)

    def _add(self) -> None:
        self._take()
        taken = {group.name for group in self.config.semantics.groups}
        name = next(n for n in ("group", *(f"group_{i}" for i in range(2, 1000))) if n not in taken)
        self.config.semantics.add_group(srdf.Group(name))
        self._fill(len(self.config.semantics.groups) - 1)
        self._name.setFocus()
        self._name.selectAll()

    def _remove(self) -> None:
        if self._group is not None:
            self.session.remove_group(self._group)
            self._group = None
            self._fill(0 if self.config.semantics.groups else -1)
