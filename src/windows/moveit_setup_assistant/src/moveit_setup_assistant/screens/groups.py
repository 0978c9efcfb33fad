"""Planning groups: joints that are planned for together."""

from __future__ import annotations

from python_qt_binding.QtWidgets import QDoubleSpinBox, QHBoxLayout, QPushButton, QTabWidget, QVBoxLayout, QWidget
from srdfdom import srdf

from moveit_setup_assistant import planners
from moveit_setup_assistant.configuration import SOLVERS, Kinematics
from moveit_setup_assistant.screens.base import Screen, Table, TwoLists, add_row, allow, choice, form_layout, line
from moveit_setup_assistant.words import counted

_NUMBERS = (
    ("search_resolution", "Kin. search resolution"),
    ("timeout", "Kin. search timeout (s)"),
    ("goal_joint_tolerance", "Goal joint tolerance"),
    ("goal_position_tolerance", "Goal position tolerance (m)"),
    ("goal_orientation_tolerance", "Goal orientation tolerance (rad)"),
)


class GroupsScreen(Screen):
    """The table of groups, and for the marked one its solver, planner and members."""

    title = "Planning Groups"
    about = (
        "A planning group is an arm, a gripper, or both: joints that are planned for together. Most arms are one chain, from the "
        "base to the link that is moved."
    )

    def __init__(self, session) -> None:
        super().__init__(session)
        self._group = None
        self._list = Table("groups_list", ("Group", "Solver", "Members"))
        row = self._list.verticalHeader().defaultSectionSize()
        self._list.setMinimumHeight(3 * row)
        self._list.setMaximumHeight(8 * row)
        self._list.itemSelectionChanged.connect(lambda: self._choose(self._list.row()))
        self.layout_.addWidget(self._list, 1)
        row = QHBoxLayout()
        self._buttons = {}
        for text, name, action in (("&Add Group", "add", self._add), ("&Delete Group", "delete", self._remove)):
            button = self._buttons[name] = QPushButton(text)
            button.setObjectName(f"groups_{name}")
            button.clicked.connect(action)
            row.addWidget(button)
        self.layout_.addLayout(row)
        self._right = QWidget()
        right = QVBoxLayout(self._right)
        right.setContentsMargins(0, 0, 0, 0)
        named = form_layout()
        self._name = line()
        self._name.setObjectName("groups_name")
        self._name.editingFinished.connect(self._rename)
        named.addRow("Group name", self._name)
        right.addLayout(named)
        right.addWidget(self._tabs_of(self._settings(), self._members()))
        self.layout_.addWidget(self._right, 2)

    def _settings(self) -> QWidget:
        """How poses of the group are solved, and who plans."""
        page = QWidget()
        form = form_layout(page)
        self._solver = choice(("None", *SOLVERS), editable=True)
        self._planner, self._file = choice(("None", *planners.names())), line()
        self._numbers = {}
        add_row(form, "Kinematic solver", self._solver)
        for key, text in _NUMBERS:
            box = self._numbers[key] = QDoubleSpinBox()
            box.setDecimals(5)
            box.setRange(0, 1000)
            box.setSingleStep(0.005)
            box.setObjectName(f"groups_{key}")
            form.addRow(text, box)
        form.addRow("Kin. parameters file", self._file)
        form.addRow("Group default planner", self._planner)
        for widget, name in ((self._solver, "solver"), (self._planner, "planner"), (self._file, "file")):
            widget.setObjectName(f"groups_{name}")
        self._solver.currentTextChanged.connect(self._allow_solving)
        return page

    def _allow_solving(self, solver: str) -> None:
        """What only a solver reads can be set while there is one."""
        for widget in (*self._numbers.values(), self._file):
            allow(widget, "Choose a kinematic solver first." if solver.strip() in ("", "None") else "")

    def _members(self) -> list[tuple[str, QWidget]]:
        """What the group is made of, in pages of their own."""
        self._lists = {kind: TwoLists(f"Available {kind}", "In the group", f"groups_{kind}") for kind in ("joints", "links", "subgroups")}
        for lists in self._lists.values():
            lists.changed.connect(self._take)
        for kind in ("joints", "links"):
            self._lists[kind].looked_at.connect(
                lambda names, kind=kind: self.session.highlight(names if kind == "links" else [self.session.child_of(n) for n in names])
            )
        self._base, self._tip = choice(), choice()
        self._base.setObjectName("groups_base_link")
        self._tip.setObjectName("groups_tip_link")
        chain = QWidget()
        form = form_layout(chain)
        for text, box in (("Base link", self._base), ("Tip link", self._tip)):
            form.addRow(text, box)
            box.activated.connect(lambda _index: self._take())
        return [("Kin. Chain", chain), *((kind.capitalize(), lists) for kind, lists in self._lists.items())]

    def _tabs_of(self, settings: QWidget, members: list[tuple[str, QWidget]]) -> QTabWidget:
        self._tabs = QTabWidget()
        self._tabs.setObjectName("groups_members")
        for title, page in (("Solver", settings), *members):
            page.layout().setContentsMargins(8, 8, 8, 8)
            self._tabs.addTab(page, title)
        return self._tabs

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
        self._list.show_rows([self._cells(group) for group in self.config.semantics.groups], row)
        if row < 0:
            self._clear()
        self._right.setEnabled(row >= 0)
        allow(self._buttons["delete"], "" if row >= 0 else "Mark a group in the table first.")

    def _cells(self, group) -> tuple[str, str, str]:
        """The row of a group: its name, its solver, and what it is made of."""
        solved = self.config.kinematics.get(group.name)
        members = [f"{chain.base_link} to {chain.tip_link}" for chain in group.chains]
        counts = (("joint", group.joints), ("link", group.links), ("subgroup", group.groups))
        members += [counted(len(found), what) for what, found in counts if found]
        return group.name, solved.solver.split("/")[-1] if solved and solved.solver else "None", ", ".join(members)

    def _clear(self) -> None:
        """No group is shown."""
        self._name.clear()
        self._solver.setCurrentText("None")
        self._planner.setCurrentText("None")
        for box in (self._base, self._tip):
            box.setCurrentIndex(0)
        for lists in self._lists.values():
            lists.set([], [])

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
        self._tabs.setTabEnabled(self._tabs.count() - 1, len(groups) > 1)
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
        row = self.config.semantics.groups.index(group)
        if row < self._list.rowCount():
            self._list.rewrite(row, self._cells(group))

    def _rename(self) -> None:
        group, name = self._group, self._name.text().strip()
        if group is None or name == group.name:
            return
        if not name or any(c.isspace() for c in name) or any(g.name == name for g in self.config.semantics.groups):
            self.session.say(f"'{name}' cannot be a group's name: it is empty, has blanks, or is taken.", bad=True)
            self._name.setText(group.name)
            return
        self.session.rename_group(group, name)
        self._list.rewrite(self._list.row(), self._cells(group))

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
