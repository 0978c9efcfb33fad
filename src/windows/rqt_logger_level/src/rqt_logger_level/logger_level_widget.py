"""Three lists: nodes, loggers, levels."""

from python_qt_binding.QtCore import QSize
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import QGridLayout, QLabel, QListWidget, QPushButton, QWidget
from rqt_py_common.background import Background
from rqt_py_common.empty_text import EmptyText

from .logger_level_service_caller import LEVELS, LoggerLevelServiceCaller


class LoggerLevelWidget(QWidget):
    """A click on a level sets it at once."""

    def __init__(self, caller=None):
        """:param caller: LoggerLevelServiceCaller or the like"""
        super().__init__()
        self.setObjectName("LoggerLevelWidget")
        self.setWindowTitle("Logger Level")
        self._caller = caller or LoggerLevelServiceCaller()
        self._background = Background(self)
        self._levels = {}  # of the loggers shown
        layout = QGridLayout(self)
        lists = []
        for column, (name, title) in enumerate((("node_list", "Nodes"), ("logger_list", "Loggers"), ("level_list", "Levels"))):
            entries = QListWidget()
            entries.setObjectName(name)
            layout.addWidget(QLabel(title), 0, column)
            layout.addWidget(entries, 1, column)
            lists.append(entries)
        self.node_list, self.logger_list, self.level_list = lists
        EmptyText(self.logger_list, "Choose a node.")
        self.refresh_button = QPushButton(QIcon.fromTheme("view-refresh"), "Refresh")
        self.refresh_button.setObjectName("refresh_button")
        self.refresh_button.clicked.connect(lambda: self.refresh_nodes())
        self.status_label = QLabel()
        self.status_label.setObjectName("status_label")
        self.status_label.setWordWrap(True)
        layout.addWidget(self.refresh_button, 2, 0)
        layout.addWidget(self.status_label, 2, 1, 1, 2)
        layout.setColumnStretch(0, 2)
        layout.setColumnStretch(1, 2)
        layout.setColumnStretch(2, 1)
        self.node_list.currentTextChanged.connect(self._node_changed)
        self.logger_list.currentTextChanged.connect(self._logger_changed)
        self.level_list.currentTextChanged.connect(self._level_changed)

    def sizeHint(self) -> QSize:
        return QSize(750, 350)

    def refresh_nodes(self) -> None:
        self._background.run("nodes", self._caller.get_node_names, self._show_nodes, self._failed)

    def close_calls(self) -> None:
        """Nothing that still runs is shown any more."""
        self._background.close()

    def _failed(self, error) -> None:
        self.status_label.setText(str(error))

    def _show_nodes(self, names) -> None:
        self.status_label.clear()
        chosen = self.node_list.currentItem().text() if self.node_list.currentItem() else None
        self.node_list.blockSignals(True)
        self.node_list.clear()
        self.node_list.addItems(names)
        self.node_list.blockSignals(False)
        self._clear(self.logger_list, self.level_list)
        if chosen in names:
            self.node_list.setCurrentRow(names.index(chosen))

    def _node_changed(self, node: str) -> None:
        self._clear(self.logger_list, self.level_list)
        self._background.forget("loggers")
        if node:
            self._background.run("loggers", lambda: self._caller.get_loggers(node), self._show_loggers, self._failed)

    def _show_loggers(self, levels) -> None:
        self.status_label.clear()
        self._levels = dict(levels)
        self.logger_list.addItems(list(levels))
        if levels:
            self.logger_list.setCurrentRow(0)

    def _logger_changed(self, logger: str) -> None:
        self._clear(self.level_list)
        if logger:
            self.level_list.blockSignals(True)
            self.level_list.addItems(LEVELS)
            if self._levels.get(logger) in LEVELS:
                self.level_list.setCurrentRow(LEVELS.index(self._levels[logger]))
            self.level_list.blockSignals(False)

    def _level_changed(self, level: str) -> None:
        node, logger = self.node_list.currentItem(), self.logger_list.currentItem()
        if level and node is not None and logger is not None:
            node, logger = node.text(), logger.text()
            self._background.run(
                ("set", node, logger, level),
                lambda: self._caller.set_logger_level(node, logger, level),
                lambda _: self._was_set(node, logger, level),
                self._failed,
            )

    def _was_set(self, node: str, logger: str, level: str) -> None:
        self.status_label.setText(f"{node}: {logger} is at {level}")
        self._levels[logger] = level

    @staticmethod
    def _clear(*lists) -> None:
        for entries in lists:
            entries.blockSignals(True)
            entries.clear()
            entries.blockSignals(False)
