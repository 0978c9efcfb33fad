"""Asks which topics are to be recorded."""

from __future__ import annotations

from python_qt_binding.QtCore import Qt, Signal
from python_qt_binding.QtWidgets import QListWidget, QListWidgetItem, QPushButton, QVBoxLayout, QWidget


class TopicSelection(QWidget):
    """A list of topics with check boxes. :param topics: names."""

    recordSettingsSelected = Signal(bool, list)  #: all, or the names chosen

    def __init__(self, topics: list[str]):
        super().__init__()
        self.setObjectName("topic_selection")
        self.setWindowTitle("Select the topics you want to record")
        self.resize(500, 500)
        self.list = QListWidget()
        self.list.setObjectName("record_topics")
        for text in ["All"] + sorted(topics):
            item = QListWidgetItem(text, self.list)
            item.setFlags(item.flags() | Qt.ItemFlag.ItemIsUserCheckable)
            item.setCheckState(Qt.CheckState.Unchecked)
        self.list.itemChanged.connect(self._changed)
        self.button = QPushButton("Record")
        self.button.setObjectName("record_selected")
        self.button.setEnabled(False)
        self.button.clicked.connect(lambda: self._record())
        layout = QVBoxLayout(self)
        layout.addWidget(self.list)
        layout.addWidget(self.button)

    def _checked(self) -> list[str]:
        items = [self.list.item(row) for row in range(self.list.count())]
        return [item.text() for item in items if item.checkState() == Qt.CheckState.Checked]

    def _changed(self, item) -> None:
        if self.list.row(item) == 0:
            for row in range(1, self.list.count()):
                self.list.item(row).setCheckState(item.checkState())
        self.button.setEnabled(bool(self._checked()))

    def _record(self) -> None:
        checked = self._checked()
        self.close()
        self.recordSettingsSelected.emit("All" in checked, [name for name in checked if name != "All"])
