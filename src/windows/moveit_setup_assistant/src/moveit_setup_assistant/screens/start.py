"""Start: a new package, or one to edit."""

from __future__ import annotations

from pathlib import Path

import rospkg
from python_qt_binding.QtWidgets import QButtonGroup, QFileDialog, QHBoxLayout, QLabel, QPushButton, QWidget

from moveit_setup_assistant.configuration import Configuration
from moveit_setup_assistant.errors import AssistantError, files_told
from moveit_setup_assistant.robot_source import RobotSource
from moveit_setup_assistant.screens.base import Screen, allow, form_layout, line


class StartScreen(Screen):
    """Loads a robot's description, or a package that an assistant made."""

    title = "Start"
    about = (
        "A configuration package says how MoveIt plans for your robot. Make a new one from the robot's URDF or xacro file, or "
        "edit one that this assistant, or MoveIt's own, made before."
    )

    def __init__(self, session) -> None:
        super().__init__(session)
        row, choices = QHBoxLayout(), QButtonGroup(self)
        self._new = QPushButton("Create &New MoveIt\nConfiguration Package")
        self._edit = QPushButton("&Edit Existing MoveIt\nConfiguration Package")
        for button, name in ((self._new, "start_new"), (self._edit, "start_edit")):
            button.setObjectName(name)
            button.setCheckable(True)
            button.setMinimumHeight(64)
            choices.addButton(button)
            row.addWidget(button)
        self.layout_.addLayout(row)
        self.layout_.addWidget(self._form())
        self.layout_.addStretch(1)
        choices.buttonToggled.connect(self._choose)

    def _form(self) -> QWidget:
        """What is asked once a button is pressed."""
        self._path, self._arguments, self._file = line(), line(), QLabel()
        self._path.setObjectName("start_path")
        self._arguments.setObjectName("start_xacro_args")
        browse, self._load = QPushButton("&Browse"), QPushButton("&Load Files")
        browse.setObjectName("start_browse")
        self._load.setObjectName("start_load")
        self._load.setMinimumHeight(36)
        browse.clicked.connect(self._browse)
        self._load.clicked.connect(self.load)
        self._path.textChanged.connect(self._allow)
        row = QHBoxLayout()
        row.addWidget(self._path)
        row.addWidget(browse)
        self._asked = QWidget()
        form = form_layout(self._asked)
        form.setContentsMargins(0, 12, 0, 0)
        form.addRow(self._file)
        form.addRow(row)
        form.addRow("xacro arguments (optional)", self._arguments)
        form.addRow(self._load)
        self._asked.hide()
        return self._asked

    def _choose(self, *_) -> None:
        if self._edit.isChecked():
            self._file.setText("Name of the package, or its folder:")
        else:
            self._file.setText("URDF or xacro file of the robot:")
        self._asked.setVisible(self._new.isChecked() or self._edit.isChecked())
        self._allow()

    def _allow(self, *_) -> None:
        text = self._path.text().strip()
        allow(self._load, "" if text else "Name the file or the package first.")
        if self._edit.isChecked():
            why = "The package holds its own."
        else:
            why = "" if _is_xacro(text) else "Only a xacro file has arguments."
        allow(self._arguments, why)

    def show_package(self, name: str) -> None:
        """Prepare to edit the package of that name, or in that folder."""
        self._edit.setChecked(True)
        self._path.setText(name)

    def show_urdf(self, path: str) -> None:
        """Prepare to make a package for the robot of this file."""
        self._new.setChecked(True)
        self._path.setText(path)

    def load(self) -> None:
        """Load what the form names; the other screens are open then."""
        text = self._path.text().strip()
        arguments = self._arguments.text().strip() if self._arguments.isEnabled() else ""
        if not self.session.may_forget("Load other files"):
            return
        try:
            if self._new.isChecked():
                self.session.open(Configuration.new(RobotSource.from_file(text, arguments)), None)
            else:
                package = _package_folder(text)
                self.session.open(Configuration.load(package), package)
        except AssistantError as error:
            self.session.say(str(error), bad=True)

    def _browse(self) -> None:
        if self._new.isChecked():
            found = QFileDialog.getOpenFileName(self, "Robot description", self._path.text(), "Robots (*.urdf *.xacro);;All files (*)")[0]
        else:
            found = QFileDialog.getExistingDirectory(self, "Configuration package", self._path.text())
        if found:
            self._path.setText(found)


def _is_xacro(text: str) -> bool:
    """Whether ``text`` names a file that goes through xacro."""
    try:
        return bool(text) and RobotSource.from_file(text).is_xacro
    except AssistantError:
        return False


@files_told()
def _package_folder(text: str) -> Path:
    """The folder that ``text`` names, or that of the package of this name."""
    folder = Path(text).expanduser()
    if folder.is_dir():
        return folder.absolute()
    try:
        return Path(rospkg.RosPack().get_path(text))
    except rospkg.ResourceNotFound as error:
        raise AssistantError(f"'{text}' is neither a folder nor a package that is found; source the workspace that holds it") from error
