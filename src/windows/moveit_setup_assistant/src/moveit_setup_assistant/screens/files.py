"""Configuration files: what is written, and where."""

from __future__ import annotations

from pathlib import Path

from python_qt_binding.QtCore import Qt, QTimer
from python_qt_binding.QtWidgets import QFileDialog, QHBoxLayout, QLabel, QMessageBox, QPlainTextEdit, QPushButton, QSplitter

from moveit_setup_assistant import package_writer
from moveit_setup_assistant.errors import AssistantError
from moveit_setup_assistant.package_writer import PlannedFile
from moveit_setup_assistant.screens.base import CHECKED, UNCHECKED, Screen, Table, allow, hint, line

_AT_REST = 300  # ms after the last key: the folder is typed


class FilesScreen(Screen):
    """Lists the files with what each is for; ticked ones are written."""

    title = "Configuration Files"
    about = (
        "Ticked files are written. Files that somebody changed by hand since the package was made are not ticked: tick one to overwrite it."
    )

    def __init__(self, session) -> None:
        super().__init__(session)
        self._files: list[PlannedFile] = []
        self._folder, browse = line(), QPushButton("&Browse")
        self._folder.setObjectName("files_folder")
        self._folder.setPlaceholderText("for example ~/catkin_ws/src/my_robot_moveit_config")
        browse.setObjectName("files_browse")
        browse.clicked.connect(self._browse)
        row = QHBoxLayout()
        row.addWidget(QLabel("Package folder"))
        row.addWidget(self._folder)
        row.addWidget(browse)
        self.layout_.addLayout(row)
        self._list, self._text, split = Table("files_list", ("Write", "File", "What for")), QPlainTextEdit(), QSplitter(Qt.Vertical)
        self._text.setObjectName("files_text")
        self._text.setReadOnly(True)
        self._text.setLineWrapMode(QPlainTextEdit.NoWrap)
        self._list.itemSelectionChanged.connect(self._look)
        self._list.itemChanged.connect(self._ticked)
        split.addWidget(self._list)
        split.addWidget(self._text)
        self.layout_.addWidget(split, 1)
        self._hint = hint("files_hint")
        self.layout_.addWidget(self._hint)
        self.layout_.addLayout(self._make_buttons())
        self._typed = QTimer(self)
        self._typed.setSingleShot(True)
        self._typed.timeout.connect(self._plan)
        self._folder.editingFinished.connect(self._plan)
        self._folder.textChanged.connect(lambda _text: self._typed.start(_AT_REST))

    def _make_buttons(self) -> QHBoxLayout:
        row = QHBoxLayout()
        self._generate_button, leave = QPushButton("&Generate Package"), QPushButton("E&xit Setup Assistant")
        self._generate_button.setObjectName("files_generate")
        self._generate_button.clicked.connect(self._generate)
        leave.setObjectName("files_exit")
        leave.clicked.connect(lambda: self.window().close())
        for button in (self._generate_button, leave):
            button.setMinimumHeight(36)
            row.addWidget(button)
        return row

    def enter(self) -> None:
        if self.session.package is not None:
            self._folder.setText(str(self.session.package))
        self._plan()

    def leave(self):
        self._typed.stop()
        return None

    def _plan(self) -> None:
        """Look at the folder: what would be written, and what stands against it."""
        self._typed.stop()
        self._files, why = [], "Name the folder of the package."
        try:
            if self._folder.text().strip():
                self._files = package_writer.plan(self.config, self._package())
                why = "\n".join(self.config.problems())
        except AssistantError as error:
            why = str(error)
        self._hint.setText(why)
        allow(self._generate_button, why)
        self._list.show_rows([(file.state.value, file.path, file.purpose) for file in self._files])
        self._list.blockSignals(True)
        for row, file in enumerate(self._files):
            self._list.item(row, 0).setCheckState(CHECKED if file.write else UNCHECKED)
        self._list.blockSignals(False)
        self._list.spread()
        self._text.clear()

    def _package(self) -> Path:
        return Path(self._folder.text().strip()).expanduser().absolute()

    def _look(self) -> None:
        row = self._list.row()
        if 0 <= row < len(self._files):
            self._text.setPlainText(self._files[row].text)

    def _ticked(self, item) -> None:
        if item.column() == 0:
            self._files[item.row()].write = item.checkState() == CHECKED

    def _browse(self) -> None:
        found = QFileDialog.getExistingDirectory(self, "Folder of the package", self._folder.text())
        if found:
            self._folder.setText(found)
            self._plan()

    def _generate(self) -> None:
        incomplete = self.config.incomplete()
        if (
            incomplete
            and QMessageBox.question(self, "Incomplete", "\n".join([*incomplete, "", "Write the package all the same?"])) != QMessageBox.Yes
        ):
            return
        package = self._package()
        try:
            written = package_writer.write(self.config, package, self._files)
        except AssistantError as error:
            self.session.say(str(error), bad=True)
            return
        self.session.package = package
        self.session.kept()
        self._plan()
        typed = self._folder.text().strip()
        shown = typed if typed.startswith("~") else package
        self.session.say(f"Wrote {len(written)} files to {shown}. Build your workspace, then: roslaunch {package.name} demo.launch")
