"""The plugin: /diagnostics, sorted by level."""

import html
import time
from collections import deque
from typing import Any

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from python_qt_binding.QtCore import Qt, QTimer
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import QSplitter, QTextBrowser, QTreeWidget, QTreeWidgetItem
from rqt_gui_py.plugin import Plugin

STALE = 3
SILENCE = 5.0  # s after which a status is stale
PERIOD = 250  # ms
_GROUPS = {
    STALE: ("Stale", "dialog-question"),
    DiagnosticStatus.ERROR: ("Errors", "dialog-error"),
    DiagnosticStatus.WARN: ("Warnings", "dialog-warning"),
    DiagnosticStatus.OK: ("Messages", "dialog-information"),
}


class RuntimeMonitor(Plugin):
    """Every status is below its level; the chosen one is shown in full."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("RuntimeMonitor")
        self._queue: deque[Any] = deque(maxlen=1000)
        self._statuses = {}  # name -> (status, s of arrival, level shown, item)
        self._widget = QSplitter(Qt.Orientation.Vertical)
        self._widget.setObjectName("RuntimeMonitorWidget")
        number = context.serial_number()
        self._widget.setWindowTitle("Runtime Monitor" + (f" ({number})" if number > 1 else ""))
        self.tree, self.text = QTreeWidget(), QTextBrowser()
        self.tree.setObjectName("tree_widget")
        self.text.setObjectName("html_browser")
        self.tree.setHeaderHidden(True)
        self.tree.setMinimumSize(450, 200)
        self.tree.itemSelectionChanged.connect(self._show_selected)
        self._widget.addWidget(self.tree)
        self._widget.addWidget(self.text)
        self._groups = {}
        for level, (_name, icon) in _GROUPS.items():
            self._groups[level] = QTreeWidgetItem([""])
            self._groups[level].setIcon(0, QIcon.fromTheme(icon))
            self.tree.addTopLevelItem(self._groups[level])
            self._groups[level].setExpanded(level != DiagnosticStatus.OK)
        context.add_widget(self._widget)
        self._subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, self._queue.append)
        self._timer = QTimer(self)
        self._timer.timeout.connect(lambda: self.update(time.monotonic()))
        self._timer.start(PERIOD)
        self.update(time.monotonic())

    def update(self, now: float) -> None:
        """Take what has come; what has been silent for long is stale.

        :param now: s
        """
        for _ in range(len(self._queue)):
            for status in self._queue.popleft().status:
                self._put(status, now, status.level if status.level in _GROUPS else DiagnosticStatus.ERROR)
        for status, arrival, level, _ in list(self._statuses.values()):
            if level != STALE and now - arrival > SILENCE:
                self._put(status, arrival, STALE)
        for level, (name, _) in _GROUPS.items():
            self._groups[level].setText(0, f"{name} ({self._groups[level].childCount()})")

    def _put(self, status, arrival: float, level: int) -> None:
        _, _, old_level, item = self._statuses.get(status.name, (None, None, None, None))
        if old_level != level:
            selected = item is not None and item.isSelected()
            if item is not None:
                self._groups[old_level].removeChild(item)
            item = item or QTreeWidgetItem()
            self._groups[level].addChild(item)
            item.setSelected(selected)
        item.setText(0, f"{status.name}: {status.message}")
        self._groups[level].sortChildren(0, Qt.SortOrder.AscendingOrder)
        item.setData(0, Qt.ItemDataRole.UserRole, status.name)
        self._statuses[status.name] = (status, arrival, level, item)
        if item.isSelected():
            self._show_selected()

    def _show_selected(self) -> None:
        chosen = [item.data(0, Qt.ItemDataRole.UserRole) for item in self.tree.selectedItems()]
        if not chosen or chosen[0] is None:
            return
        status, _, level, _ = self._statuses[chosen[0]]
        lines = [
            ("Component", status.name),
            ("Message", status.message),
            ("Hardware ID", status.hardware_id),
            ("Level", _GROUPS[level][0]),
        ] + [(pair.key, pair.value) for pair in status.values]
        place = self.text.verticalScrollBar().value()
        self.text.setHtml("".join(f"<b>{html.escape(key)}</b>: {html.escape(value)}<br>" for key, value in lines))
        self.text.verticalScrollBar().setValue(place)

    def shutdown_plugin(self) -> None:
        self._timer.stop()
        self._subscriber.unregister()

    def save_settings(self, plugin_settings, instance_settings) -> None:
        instance_settings.set_value("splitter", self._widget.saveState())

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        if instance_settings.contains("splitter"):
            self._widget.restoreState(instance_settings.value("splitter"))
