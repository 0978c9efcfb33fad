"""The plugin Process Monitor of rqt."""

from __future__ import annotations

import re
import textwrap
import threading

import rosgraph
from python_qt_binding.QtCore import Qt, Signal, qWarning
from python_qt_binding.QtWidgets import (
    QCheckBox,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)
from rqt_gui_py.plugin import Plugin
from rqt_py_common.empty_text import EmptyText

from rqt_top.node_info import NodeInfo, NodeUsage

_PERIOD = 1.0  # s
_LABELS = ("Node", "PID", "CPU %", "Mem %", "Num Threads")


class _Item(QTreeWidgetItem):
    """A row that is sorted by numbers where there are numbers."""

    def __lt__(self, other) -> bool:
        column = self.treeWidget().sortColumn()
        if column == 0:
            return self.text(0) < other.text(0)
        return float(self.text(column)) < float(other.text(column))


class Top(Plugin):
    """A table of nodes with what their processes take."""

    _looked = Signal(object)
    _failed = Signal(str)

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("Top")
        self._items: dict[str, _Item] = {}
        self._build()
        context.add_widget(self._container)
        self._looked.connect(self._show)
        self._failed.connect(lambda text: self._status.setText(text))
        self._info = NodeInfo()
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._look, daemon=True)
        self._thread.start()

    def _build(self) -> None:
        self._container = QWidget()
        self._container.setWindowTitle("Process Monitor")
        self._filter = QLineEdit()
        self._filter.setObjectName("filter")
        self._regex = QCheckBox("regex")
        self._regex.setObjectName("regex")
        self._filter.textChanged.connect(lambda _text: self._apply_filter())
        self._regex.toggled.connect(lambda _on: self._apply_filter())
        bar = QHBoxLayout()
        for widget in (QLabel("Filter"), self._filter, self._regex):
            bar.addWidget(widget)
        self._table = QTreeWidget()
        self._table.setObjectName("TopTable")
        EmptyText(self._table, "No processes of nodes yet.")
        self._table.setHeaderLabels(_LABELS)
        self._table.setRootIsDecorated(False)
        self._table.setAlternatingRowColors(True)
        self._table.setSortingEnabled(True)
        self._table.sortByColumn(0, Qt.SortOrder.AscendingOrder)
        self._table.setColumnWidth(0, 280)
        self._kill = QPushButton("Kill Node")
        self._kill.setObjectName("kill")
        self._kill.clicked.connect(lambda: self._kill_selected())
        self._status = QLabel()
        layout = QVBoxLayout(self._container)
        layout.addLayout(bar)
        layout.addWidget(self._table, 1)
        layout.addWidget(self._status)
        layout.addWidget(self._kill)

    def _look(self) -> None:
        while not self._over.is_set():
            try:
                usages = self._info.look()
                if not self._over.is_set():
                    self._looked.emit(usages)
            except (rosgraph.MasterException, OSError) as error:
                if not self._over.is_set():
                    self._failed.emit(f"the master does not answer: {error}")
            self._over.wait(_PERIOD)

    def _show(self, usages) -> None:
        self._status.setText("")
        there = {usage.name for usage in usages}
        for gone in set(self._items) - there:
            self._table.takeTopLevelItem(self._table.indexOfTopLevelItem(self._items.pop(gone)))
        self._table.setSortingEnabled(False)  # a row must not move while its cells are written
        for usage in usages:
            if usage.name not in self._items:
                self._items[usage.name] = _Item(self._table)
            self._write(self._items[usage.name], usage)
        self._table.setSortingEnabled(True)
        self._apply_filter()

    @staticmethod
    def _write(item: _Item, usage: NodeUsage) -> None:
        for column, text in enumerate(
            (usage.name, str(usage.pid), f"{usage.cpu_percent:.2f}", f"{usage.memory_percent:.2f}", str(usage.threads))
        ):
            item.setText(column, text)
        item.setToolTip(0, "\n".join(textwrap.wrap(usage.command)))
        item.setToolTip(3, f"Resident: {usage.resident / 2**20:.2f} MiB, Virtual: {usage.virtual / 2**20:.2f} MiB")

    def _apply_filter(self) -> None:
        text = self._filter.text()
        try:
            pattern = re.compile(text if self._regex.isChecked() else re.escape(text))
            self._filter.setToolTip("")
        except re.error as error:
            self._filter.setToolTip(f"no regular expression: {error}")
            return
        for name, item in self._items.items():
            item.setHidden(not pattern.search(name))

    def _kill_selected(self) -> None:
        for item in self._table.selectedItems():
            name = item.text(0)

            def kill(name: str = name) -> None:
                if not self._info.kill_node(name):
                    qWarning(f"rqt_top: {name} could not be asked to end")

            threading.Thread(target=kill, daemon=True).start()

    def save_settings(self, plugin_settings, instance_settings) -> None:
        instance_settings.set_value("filter_text", self._filter.text())
        instance_settings.set_value("is_regex", 2 if self._regex.isChecked() else 0)

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        self._regex.setChecked(str(instance_settings.value("is_regex", 0)) == "2")
        self._filter.setText(str(instance_settings.value("filter_text", "") or ""))

    def shutdown_plugin(self) -> None:
        self._over.set()
