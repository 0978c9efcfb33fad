"""The assistant's window: the list of screens on the left, the screen in the middle, the robot on the right."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable
from pathlib import Path

import motion
from node_signals.display import missing_display
from python_qt_binding.QtCore import QSize, Qt, QTimer
from python_qt_binding.QtWidgets import (
    QApplication,
    QCheckBox,
    QHBoxLayout,
    QLabel,
    QListWidget,
    QListWidgetItem,
    QMainWindow,
    QMessageBox,
    QSplitter,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)
from qt_gui.application.interrupts import Interrupts

from moveit_setup_assistant.configuration import Configuration
from moveit_setup_assistant.errors import AssistantError
from moveit_setup_assistant.robot_view import RobotView
from moveit_setup_assistant.screens import ALL
from moveit_setup_assistant.words import counted

_MOST_LINES = 4  # of what is missing, below the screen
_NARROWEST = 465  # pixels, of a screen beside the picture
_ROW = 34  # pixels, the height of a screen's entry in the list
_FRAME = QSize(10, 40)  # pixels, at most: what a window manager adds
_USABLE = Qt.ItemIsSelectable | Qt.ItemIsEnabled


class Session:
    """What the screens share: the configuration, the package's folder, the robot's model with its groups, and the picture."""

    def __init__(self, window: Window) -> None:
        self._window = window
        self.config: Configuration | None = None
        self.package: Path | None = None
        self._model = None
        self._kept: tuple | None = None

    def open(self, config: Configuration, package: Path | None) -> None:
        """Edit this configuration, ``config``, from now on. ``package``: the folder it came from."""
        self.config, self.package = config, package
        self.kept()
        self.model_changed()
        self._window.robot_changed()
        for line in config.warnings:
            self.say(line, bad=True)
        lines = [
            f"{config.robot.name}: {counted(len(config.robot.model.links), 'link')}, "
            f"{counted(len(config.robot.movable_joints), 'joint')} that can move",
            *config.warnings[:_MOST_LINES],
        ]
        if len(config.warnings) > _MOST_LINES:
            lines.append(f"and {len(config.warnings) - _MOST_LINES} more; all of them are in the terminal")
        self.say("\n".join(lines))

    def kept(self) -> None:
        """The configuration is that of the files on disk."""
        self._kept = self.edited.contents()

    def is_changed(self) -> bool:
        """Whether something was edited since the robot was loaded, or the package written."""
        return self.config is not None and self.config.contents() != self._kept

    def may_forget(self, action: str) -> bool:
        """Ask before changes are lost; True if they may be, or there are none."""
        return self._window.may_forget(action)

    def say(self, text: str, bad: bool = False) -> None:
        """``text`` for the user, below the screen; ``bad``: it is bad news."""
        self._window.say(text, bad)

    def model_changed(self) -> None:
        """The groups are no longer those of the model."""
        self._model = None

    @property
    def edited(self) -> Configuration:
        """The configuration, of a screen that is open only while there is one."""
        assert self.config is not None
        return self.config

    def model(self):
        """The robot with its groups as they are now; without them while they do not fit."""
        if self._model is None:
            try:
                self._model = self.edited.model()
            except AssistantError as error:
                self.say(str(error), bad=True)
                self._model = self.edited.robot.model
        return self._model

    def links_of(self, group: str) -> list[str]:
        """The links of a group; none if there is no such group."""
        model = self.model()
        return list(model.group(group).links) if model.has_group(group) else []

    def joints_of(self, group: str) -> list[str]:
        """The joints that a group moves; none if there is no such group."""
        model = self.model()
        return list(model.group(group).active_joints) if model.has_group(group) else []

    def child_of(self, joint: str) -> str:
        """The link that a joint moves."""
        model = self.edited.robot.model
        return model.joint(joint).child_link if model.has_joint(joint) else ""

    def highlight(self, links: Iterable[str]) -> None:
        """Light up these links in the picture."""
        self._window.view.highlight(links)

    def show_state(self, state) -> None:
        """Show the robot in this state."""
        self._window.view.set_state(state)

    def collisions(self, state) -> list[tuple[str, str]]:
        """Pairs of links that touch in this state and are checked."""
        found = motion.PlanningScene(self.model()).check(state, contacts=20, world=False)
        return sorted({(contact.body_1, contact.body_2) for contact in found.contacts})

    def rename_group(self, group, name: str) -> None:
        """Give a group another name, everywhere."""
        document, old = self.edited.semantics, group.name
        for state in document.group_states:
            if state.group == old:
                state.group = name
        for effector in document.end_effectors:
            if effector.group == old:
                effector.group = name
            if effector.parent_group == old:
                effector.parent_group = name
        for other in document.groups:
            for member in other.groups:
                member.name = name if member.name == old else member.name
        solvers, chosen = self.edited.kinematics, self.edited.default_planners
        if old in solvers:
            solvers[name] = solvers.pop(old)
        if old in chosen:
            chosen[name] = chosen.pop(old)
        group.name = name
        self._groups_changed()

    def remove_group(self, group) -> None:
        """Take a group out, with its poses and end effectors, and out of other groups."""
        document, name = self.edited.semantics, group.name
        document.groups.remove(group)
        document.group_states[:] = [state for state in document.group_states if state.group != name]
        document.end_effectors[:] = [e for e in document.end_effectors if e.group != name]
        for other in document.groups:
            other.groups[:] = [member for member in other.groups if member.name != name]
        self.edited.kinematics.pop(name, None)
        self.edited.default_planners.pop(name, None)
        self._groups_changed()

    def _groups_changed(self) -> None:
        document = self.edited.semantics
        document.group_map = {group.name: group for group in document.groups}
        self.model_changed()


class Window(QMainWindow):
    """The whole window."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("moveit_setup_assistant")
        self.setWindowTitle("MoveIt Setup Assistant")
        self.resize(1180, 760)
        self.session = Session(self)
        self._may_ask = True
        self.view = RobotView()
        self.view.problem.connect(lambda text: self.say(text, bad=True))
        self._beside = self._view_with_boxes()
        self.screens = [make(self.session) for make in ALL]
        self.list, self.stack = self._list_of_screens(), QStackedWidget()
        for screen in self.screens:
            self.stack.addWidget(screen)
        self.stack.setMinimumWidth(_NARROWEST)
        self._said = QLabel()
        self._said.setObjectName("said")
        self._said.setWordWrap(True)
        splitter = QSplitter()
        splitter.setChildrenCollapsible(False)
        splitter.addWidget(self.stack)
        splitter.addWidget(self._beside)
        splitter.setSizes([625, 360])
        middle, page = QVBoxLayout(), QWidget()
        middle.addWidget(splitter, 1)
        middle.addWidget(self._said)
        row = QHBoxLayout(page)
        row.addWidget(self.list)
        row.addLayout(middle, 1)
        self.setCentralWidget(page)
        self._current = 0
        self.list.setCurrentRow(0)
        self.list.currentRowChanged.connect(self._go)
        self._allow()

    def _list_of_screens(self) -> QListWidget:
        made = QListWidget()
        made.setObjectName("screens")
        for screen in self.screens:
            item = QListWidgetItem(screen.title, made)
            item.setSizeHint(QSize(made.fontMetrics().horizontalAdvance(screen.title) + 12, _ROW))
        made.setFixedWidth(made.sizeHintForColumn(0) + 2 * made.frameWidth())
        made.setMinimumHeight(len(self.screens) * _ROW + 2 * made.frameWidth())
        return made

    def _view_with_boxes(self) -> QWidget:
        """The picture, with what is drawn of the robot below it; not there before there is a robot."""
        made, row = QWidget(), QHBoxLayout()
        column = QVBoxLayout(made)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.view, 1)
        column.addLayout(row)
        boxes = [QCheckBox("visual"), QCheckBox("collision")]
        for box in boxes:
            box.setObjectName(f"view_{box.text()}")
            box.setChecked(box is boxes[0])
            box.toggled.connect(lambda _on: self.view.set_drawn(*(box.isChecked() for box in boxes)))
            row.addWidget(box)
        row.addStretch(1)
        made.hide()
        return made

    def say(self, text: str, bad: bool = False) -> None:
        """``text`` below the screen, on the terminal too if it is ``bad`` news."""
        self._said.setText(text)
        self._said.setStyleSheet("color: #a00000" if bad else "")
        if bad:
            print(f"moveit_setup_assistant: {text}", file=sys.stderr)

    def robot_changed(self) -> None:
        """Another robot was loaded: show it, and open the other screens."""
        self._beside.show()
        self.view.set_robot(self.session.edited.robot)
        self._allow()

    def edit(self, package: str) -> None:
        """Load a package, as the first screen's button does."""
        self.screens[0].show_package(package)
        QTimer.singleShot(0, self.screens[0].load)

    def _allow(self) -> None:
        for row in range(1, self.list.count()):
            self.list.item(row).setFlags(Qt.NoItemFlags if self.session.config is None else _USABLE)

    def _go(self, row: int) -> None:
        if row < 0 or row == self._current:
            return
        if self.session.config is not None:
            refused = self.screens[self._current].leave()
            if refused:
                self.list.blockSignals(True)
                self.list.setCurrentRow(self._current)
                self.list.blockSignals(False)
                self.say(refused, bad=True)
                return
            self.session.model_changed()
            self.view.highlight([])
        self.say("")
        self._current = row
        self.stack.setCurrentIndex(row)
        if self.session.config is not None:
            self.screens[row].enter()

    def may_forget(self, action: str) -> bool:
        """Whether changes may be lost by ``action``: asked only if there are some."""
        refused = None if self.session.config is None else self.screens[self._current].leave()
        if not self._may_ask or not (refused or self.session.is_changed()):
            return True
        text = f"What was changed since the package was loaded or written is in no file yet. {action} all the same?"
        return QMessageBox.question(self, action, text, QMessageBox.Ok | QMessageBox.Cancel) == QMessageBox.Ok

    def closeEvent(self, event) -> None:
        if not self.may_forget("Exit Setup Assistant"):
            event.ignore()
            return
        self.view.close_renderer()
        super().closeEvent(event)

    def interrupted(self) -> None:
        """End without a question: by Ctrl-C, or by whoever launched this."""
        self._may_ask = False
        self.close()


def main(words: list[str]) -> int:
    """Open the window; the exit code of the program."""
    import rospy

    parser = argparse.ArgumentParser(prog="moveit_setup_assistant", description="Make or edit a MoveIt configuration package.")
    parser.add_argument("--config_pkg", "--config-pkg", "-c", default="", help="package, or its folder, to edit")
    parser.add_argument("--urdf_path", "--urdf-path", "-u", default="", help="robot description to begin with")
    parser.add_argument("--debug", "-g", action="store_true", help="accepted; there is nothing to switch")
    options = parser.parse_args(rospy.myargv([parser.prog, *words])[1:])
    problem = missing_display()
    if problem:
        print(f"moveit_setup_assistant: {problem}; 'rosrun moveit_setup_assistant generate' needs no window", file=sys.stderr)
        return 1
    app = QApplication([parser.prog])
    window = Window()
    window.resize(window.size().boundedTo(app.primaryScreen().availableSize() - _FRAME))
    if options.config_pkg:
        window.edit(options.config_pkg)
    elif options.urdf_path:
        window.screens[0].show_urdf(options.urdf_path)
    window.show()

    def end() -> None:
        window.interrupted()
        app.quit()

    interrupts = Interrupts(end)
    code = app.exec_()
    interrupts.stop()
    return code
