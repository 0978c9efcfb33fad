"""Groups of parameters as boxes, tabs, and boxes that fold."""

from typing import Any

from python_qt_binding.QtCore import Signal
from python_qt_binding.QtWidgets import QFormLayout, QGroupBox, QPushButton, QTabWidget, QVBoxLayout, QWidget

from .param_editors import Editor, make_editor


def group_states(groups) -> dict[str, bool]:
    """Names of groups to their states, from the nested dictionaries of a configuration."""
    found = {}
    if isinstance(groups, dict):
        if "state" in groups and isinstance(groups.get("name"), str):
            found[groups["name"]] = bool(groups["state"])
        for inner in groups.values():
            found.update(group_states(inner))
    return found


class GroupWidget(QWidget):
    """A group with its editors and the groups within. ``changed`` has names and values to send together."""

    changed = Signal(dict)
    group_changed = Signal(str, bool)  # name, whether it is unfolded

    def __init__(self, description: dict):
        super().__init__()
        self.name, self.kind = description.get("name", ""), description.get("type", "")
        self.editors: dict[str, Editor] = {}
        self.groups: list[GroupWidget] = []
        self._pending: dict[str, Any] = {}
        form = QFormLayout(self)
        for parameter in description.get("parameters", []):
            editor = make_editor(parameter)
            if editor is not None:
                self.editors[editor.name] = editor
                editor.changed.connect(self._changed)
                form.addRow(editor.label(), editor)
                form.labelForField(editor).setToolTip(editor.toolTip())
        tabs = None
        for group in self._sorted(description.get("groups", {})):
            child = GroupWidget(group)
            child.changed.connect(self._children_changed)
            child.group_changed.connect(self.group_changed)
            self.groups.append(child)
            if child.kind == "tab":
                if tabs is None:
                    tabs = QTabWidget()
                    form.addRow(tabs)
                tabs.addTab(child, child.name)
            else:
                tabs = None
                form.addRow(self._box(child, group))
        if self.kind == "apply":
            self.apply_button = QPushButton(f"Apply {self.name}")
            self.apply_button.clicked.connect(self._apply)
            form.addRow(self.apply_button)

    @staticmethod
    def _sorted(groups) -> list:
        return sorted(groups.values() if isinstance(groups, dict) else groups, key=lambda group: group.get("id", 0))

    def _box(self, child: "GroupWidget", group: dict) -> QWidget:
        box = QGroupBox(child.name)
        layout = QVBoxLayout(box)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(child)
        child.box = box
        if child.kind == "collapse":
            box.setCheckable(True)
            box.toggled.connect(child.setVisible)
            box.setChecked(bool(group.get("state", True)))
            box.clicked.connect(lambda on: self.group_changed.emit(child.name, on))
        elif child.kind == "hide":
            box.setVisible(bool(group.get("state", True)))
        return box

    def show_values(self, config: dict) -> None:
        """What the server has now."""
        for name, editor in self.all_editors().items():
            if name in config and name not in self._all_pending():
                editor.show_value(config[name])
        self._show_states(group_states(config.get("groups")))

    def _show_states(self, states: dict[str, bool]) -> None:
        for group in self.groups:
            if group.name in states and group.kind == "collapse":
                group.box.setChecked(states[group.name])
            elif group.name in states and group.kind == "hide":
                group.box.setVisible(states[group.name])
            group._show_states(states)

    def _all_pending(self) -> set:
        """What waits for an Apply button."""
        return set(self._pending).union(*(group._all_pending() for group in self.groups))

    def all_editors(self) -> dict[str, Editor]:
        found = dict(self.editors)
        for group in self.groups:
            found.update(group.all_editors())
        return found

    def _changed(self, name: str, value) -> None:
        self._children_changed({name: value})

    def _children_changed(self, values: dict) -> None:
        if self.kind == "apply":
            self._pending.update(values)
        else:
            self.changed.emit(values)

    def _apply(self) -> None:
        values, self._pending = self._pending, {}
        if values:
            self.changed.emit(values)
