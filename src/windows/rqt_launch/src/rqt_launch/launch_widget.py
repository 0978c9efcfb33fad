"""Choose a launch file; start and stop its nodes."""

import time
from typing import Any

from python_qt_binding.QtCore import QSize, QTimer
from python_qt_binding.QtGui import QBrush, QColor, QIcon
from python_qt_binding.QtWidgets import (
    QComboBox,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QLineEdit,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)
from rqt_py_common.background import Background

from . import launched_node
from .launched_node import LaunchError

PERIOD = 500  # ms
COLUMNS = ("Node", "Package/type", "State", "Starts", "")
_COLORS = {"running": "#208020", "stopped": "#606060", "finished": "#606060"}


class LaunchWidget(QWidget):
    def __init__(self, launching=launched_node):
        """:param launching: the module launched_node or the like"""
        super().__init__()
        self.setObjectName("LaunchWidget")
        self.setWindowTitle("Launch")
        self._launching, self._background = launching, Background(self)
        self.nodes: list[Any] = []  # of self._launching
        self._wanted: dict[str, Any] = {}
        self.package_box, self.file_box, self.arguments_edit = QComboBox(), QComboBox(), QLineEdit()
        for box, name in (
            (self.package_box, "package_combo"),
            (self.file_box, "launchfile_combo"),
            (self.arguments_edit, "arguments_edit"),
        ):
            box.setObjectName(name)
        self.arguments_edit.setPlaceholderText("name:=value ...")
        self.package_box.currentTextChanged.connect(self._package_changed)
        self.load_button = self._button("load_button", "Load", "document-open", self.load)
        self.start_button = self._button("start_all_button", "Start all", "media-playback-start", lambda: self.start(self.nodes))
        self.stop_button = self._button("stop_all_button", "Stop all", "media-playback-stop", lambda: self.stop(self.nodes))
        self.table = QTableWidget(0, len(COLUMNS))
        self.table.setObjectName("node_table")
        self.table.setHorizontalHeaderLabels(COLUMNS)
        self.table.verticalHeader().setVisible(False)
        self.table.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
        for column in range(3):
            self.table.horizontalHeader().setSectionResizeMode(column, QHeaderView.ResizeMode.Stretch)
        self.status_label = QLabel()
        self.status_label.setObjectName("status_label")
        self.status_label.setWordWrap(True)
        top, low, layout = QHBoxLayout(), QHBoxLayout(), QVBoxLayout(self)
        for widget, stretch in ((self.package_box, 2), (self.file_box, 2), (self.arguments_edit, 2), (self.load_button, 0)):
            top.addWidget(widget, stretch)
        for widget in (self.start_button, self.stop_button):
            low.addWidget(widget)
        low.addStretch()
        layout.addLayout(top)
        layout.addWidget(self.table)
        layout.addLayout(low)
        layout.addWidget(self.status_label)
        self._timer = QTimer(self)
        self._timer.timeout.connect(lambda: self.refresh(time.monotonic()))
        self._timer.start(PERIOD)
        self._background.run("packages", self._launching.packages, self._show_packages)

    def sizeHint(self) -> QSize:
        return QSize(850, 420)

    def _button(self, name: str, text: str, icon: str, call) -> QPushButton:
        button = QPushButton(QIcon.fromTheme(icon), text)
        button.setObjectName(name)
        button.clicked.connect(lambda: call())
        return button

    def choice(self) -> dict:
        return {
            "package": self.package_box.currentText() or self._wanted.get("package", ""),
            "file": self.file_box.currentText() or self._wanted.get("file", ""),
            "arguments": self.arguments_edit.text(),
        }

    def choose(self, choice: dict) -> None:
        """What :meth:`choice` gave, as soon as the packages are known."""
        self._wanted = dict(choice)
        self.arguments_edit.setText(choice.get("arguments", ""))
        self._apply_choice()

    def _apply_choice(self) -> None:
        if self.package_box.findText(self._wanted.get("package", "")) >= 0:
            self.package_box.setCurrentText(self._wanted["package"])
            self.file_box.setCurrentText(self._wanted.get("file", ""))

    def _show_packages(self, names) -> None:
        self.package_box.addItems(names)
        self._apply_choice()

    def _package_changed(self, package: str) -> None:
        self.file_box.clear()
        self.file_box.addItems(self._launching.launch_files(package))

    def load(self) -> None:
        """Load the chosen file; nodes of the last one must have stopped."""
        if any(node.state() == "running" for node in self.nodes):
            self.status_label.setText("stop the running nodes first")
            return
        choice = self.choice()
        if self._background.run(
            "load", lambda: self._launching.load(choice["package"], choice["file"], choice["arguments"]), self._loaded, self._failed
        ):
            self.status_label.setText(f"loading {choice['file']} ...")

    def _loaded(self, nodes) -> None:
        self.nodes = nodes
        self.status_label.setText("its parameters are set" if nodes else "it has no nodes; its parameters are set")
        self.table.setRowCount(len(nodes))
        for row, node in enumerate(nodes):
            for column, text in enumerate((node.name, node.kind)):
                self.table.setItem(row, column, QTableWidgetItem(text))
            for column in (2, 3):
                self.table.setItem(row, column, QTableWidgetItem())
            button = QPushButton()
            button.setObjectName(f"toggle{node.name}")
            button.clicked.connect(lambda checked=False, node=node: (self.stop if node.state() == "running" else self.start)([node]))
            self.table.setCellWidget(row, 4, button)
        self.refresh(time.monotonic())

    def _failed(self, error) -> None:
        self.status_label.setText(str(error) if isinstance(error, LaunchError) else f"{type(error).__name__}: {error}")

    def start(self, nodes) -> None:
        for node in nodes:
            self._background.run(("node", node.name), node.start, lambda _: self.refresh(time.monotonic()), self._failed)

    def stop(self, nodes) -> None:
        for node in nodes:
            self._background.run(("node", node.name), node.stop, lambda _: self.refresh(time.monotonic()), self._failed)

    def refresh(self, now: float) -> None:
        """Show states; start those again that are to be respawned.

        :param now: s
        """
        for row, node in enumerate(self.nodes):
            state, busy = node.state(), self._background.busy(("node", node.name))
            self.table.item(row, 2).setText(state + (" ..." if busy else ""))
            self.table.item(row, 2).setForeground(QBrush(QColor(_COLORS.get(state, "#c02020"))))
            self.table.item(row, 3).setText(str(node.starts))
            button = self.table.cellWidget(row, 4)
            button.setText("Stop" if state == "running" else "Start")
            button.setEnabled(not busy)
            if node.due(now):
                self.start([node])

    def close_all(self) -> None:
        self._timer.stop()
        self._background.close()
        self._launching.stop_all(self.nodes)
