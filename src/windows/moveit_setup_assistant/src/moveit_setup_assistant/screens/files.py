"""Configuration files: what is written, and where."""

from __future__ import annotations

from pathlib import Path

from python_qt_binding.QtWidgets import (
    QFileDialog,
    QHBoxLayout,
    QLabel,
    QListWidget,
    QListWidgetItem,
    QMessageBox,
    QPlainTextEdit,
    QPushButton,
)

from moveit_setup_assistant import package_writer
from moveit_setup_assistant.errors import AssistantError
from moveit_setup_assistant.package_writer import PlannedFile, State
from moveit_setup_assistant.screens.base import CHECKED, UNCHECKED, Screen, line


class FilesScreen(Screen):
    """Lists the files with what each is for; ticked ones are written."""

    title = "Configuration Files"
    about = (
        "Ticked files are written. Files that somebody changed by hand since the package was made are not ticked: tick one to overwrite it."
    )

    def __init__(self, session) -> None:
        super().__init__(session)
        self._files: list[PlannedFile] = []
        self._folder, browse = line(), QPushButton("Browse")
        self._folder.setObjectName("files_folder")
        self._folder.editingFinished.connect(self._plan)
        browse.setObjectName("files_browse")
        browse.clicked.connect(self._browse)
        row = QHBoxLayout()
        row.addWidget(QLabel("Package folder"))
        row.addWidget(self._folder)
        row.addWidget(browse)
        self.layout_.addLayout(row)
        row = QHBoxLayout()
        self._list, self._text = QListWidget(), QPlainTextEdit()
        self._list.setObjectName("files_list")
        self._text.setObjectName("files_text")
        self._text.setReadOnly(True)
        self._list.currentRowChanged.connect(self._look)
        self._list.itemChanged.connect(self._ticked)
        row.addWidget(self._list, 1)
        row.addWidget(self._text, 1)
        self.layout_.addLayout(row)
        button = QPushButton("Generate Package")
        button.setObjectName("files_generate")
        button.clicked.connect(self._generate)
        self.layout_.addWidget(button)

    def enter(self) -> None:
        if self.session.package is not None:
            self._folder.setText(str(self.session.package))
        self._plan()

    def _plan(self) -> None:
        self._files = []
        try:
            if self._folder.text().strip():
                self._files = package_writer.plan(self.config, Path(self._folder.text().strip()).expanduser().absolute())
        except AssistantError as error:
            self.session.say(str(error), bad=True)
        self._list.blockSignals(True)
        self._list.clear()
        for file in self._files:
            item = QListWidgetItem(file.path if file.state is State.NEW else f"{file.path} ({file.state.value})")
            item.setCheckState(CHECKED if file.write else UNCHECKED)
            self._list.addItem(item)
        self._list.blockSignals(False)

    def _look(self, row: int) -> None:
        if 0 <= row < len(self._files):
            self._text.setPlainText(f"{self._files[row].path}: {self._files[row].purpose}\n\n{self._files[row].text}")

    def _ticked(self, item) -> None:
        self._files[self._list.row(item)].write = item.checkState() == CHECKED

    def _browse(self) -> None:
        found = QFileDialog.getExistingDirectory(self, "Folder of the package", self._folder.text())
        if found:
            self._folder.setText(found)
            self._plan()

    def _generate(self) -> None:
        if not self._files:
            self.session.say("Name the folder of the package first, for example ~/catkin_ws/src/my_robot_moveit_config.", bad=True)
            return
        incomplete = self.config.incomplete()
        if (
            incomplete
            and QMessageBox.question(self, "Incomplete", "\n".join([*incomplete, "", "Write the package all the same?"])) != QMessageBox.Yes
        ):
            return
        package = Path(self._folder.text().strip()).expanduser().absolute()
        try:
            written = package_writer.write(self.config, package, self._files)
        except AssistantError as error:
            self.session.say(str(error), bad=True)
            return
        self.session.package = package
        self._plan()
        self.session.say(f"Wrote {len(written)} files to {package}. Build your workspace, then: roslaunch {package.name} demo.launch")
