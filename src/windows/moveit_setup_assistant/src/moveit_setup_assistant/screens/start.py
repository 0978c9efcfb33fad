"""Start: a new package, or one to edit."""

from __future__ import annotations

from pathlib import Path

import rospkg
from python_qt_binding.QtWidgets import QFileDialog, QFormLayout, QHBoxLayout, QPushButton, QRadioButton

from moveit_setup_assistant.configuration import Configuration
from moveit_setup_assistant.errors import AssistantError, files_told
from moveit_setup_assistant.robot_source import RobotSource
from moveit_setup_assistant.screens.base import Screen, line


class StartScreen(Screen):
    """Loads a robot's description, or a package that an assistant made."""

    title = "Start"
    about = (
        "A configuration package says how MoveIt plans for your robot. Make a new one from the robot's URDF or xacro file, or "
        "edit one that this assistant, or MoveIt's own, made before."
    )

    def __init__(self, session) -> None:
        super().__init__(session)
        self._new = QRadioButton("Create New MoveIt Configuration Package")
        self._edit = QRadioButton("Edit Existing MoveIt Configuration Package")
        self._new.setObjectName("start_new")
        self._edit.setObjectName("start_edit")
        self._new.setChecked(True)
        self._path, self._arguments = line(), line()
        self._path.setObjectName("start_path")
        self._arguments.setObjectName("start_xacro_args")
        browse, load = QPushButton("Browse"), QPushButton("Load Files")
        browse.setObjectName("start_browse")
        load.setObjectName("start_load")
        browse.clicked.connect(self._browse)
        load.clicked.connect(self.load)
        for button in (self._new, self._edit):
            self.layout_.addWidget(button)
            button.toggled.connect(lambda _on: self._arguments.setEnabled(self._new.isChecked()))
        row = QHBoxLayout()
        row.addWidget(self._path)
        row.addWidget(browse)
        form = QFormLayout()
        form.addRow("File or package", row)
        form.addRow("xacro arguments", self._arguments)
        self.layout_.addLayout(form)
        self.layout_.addWidget(load)
        self.layout_.addStretch(1)

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
        try:
            if not text:
                raise AssistantError("Name the robot's URDF or xacro file, or the package to edit.")
            if self._new.isChecked():
                self.session.open(Configuration.new(RobotSource.from_file(text, self._arguments.text().strip())), None)
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
