"""Trees of aggregated diagnostics and the last half minute of them."""

import time
from collections import deque
from typing import Any

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from python_qt_binding.QtCore import QSize, Qt, QTimer, Signal
from python_qt_binding.QtGui import QColor, QIcon, QPainter
from python_qt_binding.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QLabel,
    QPlainTextEdit,
    QPushButton,
    QSplitter,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)
from rqt_py_common.empty_text import EmptyText

HISTORY = 30  # messages that can be looked back on
SILENCE = 10.0  # s after which all is stale
STALE = 3
_EMPTY = {
    "errors": "No errors.",
    "warnings": "No warnings.",
    "all": "Nobody publishes /diagnostics_agg: diagnostic_aggregator makes it of /diagnostics.",
}
LEVELS = {
    DiagnosticStatus.OK: ("OK", "#2eb82e", "dialog-information"),
    DiagnosticStatus.WARN: ("Warning", "#e0b020", "dialog-warning"),
    DiagnosticStatus.ERROR: ("Error", "#d93030", "dialog-error"),
    STALE: ("Stale", "#6080c0", "dialog-question"),
}


def known_level(level: int) -> int:
    return level if level in LEVELS else DiagnosticStatus.ERROR


def worst(statuses) -> int:
    return max((known_level(status.level) for status in statuses), default=DiagnosticStatus.OK)


class Timeline(QWidget):
    """A coloured cell per message; a click looks back on it."""

    chosen = Signal(int)

    def __init__(self):
        super().__init__()
        self.setObjectName("timeline")
        self.setMinimumHeight(28)
        self.setToolTip("A click shows what was; Resume goes back to now.")
        self.levels, self.selected = [], -1

    def show_levels(self, levels, selected: int) -> None:
        """Show ``levels``, those of diagnostic_msgs/DiagnosticStatus, oldest first, with a frame around the one with the number
        ``selected``.
        """
        self.levels, self.selected = levels, selected
        self.update()

    def paintEvent(self, _event) -> None:
        painter, width = QPainter(self), self.width() / HISTORY
        for number, level in enumerate(self.levels):
            painter.fillRect(
                int(number * width), 0, int((number + 1) * width) - int(number * width) - 1, self.height() - 1, QColor(LEVELS[level][1])
            )
            if number == self.selected:
                painter.setPen(QColor("black"))
                painter.drawRect(int(number * width), 0, int(width) - 2, self.height() - 2)
        painter.end()

    def mousePressEvent(self, event) -> None:
        number = int(event.pos().x() * HISTORY / max(1, self.width()))
        if 0 <= number < len(self.levels):
            self.chosen.emit(number)


class RobotMonitorWidget(QWidget):
    """:param context: of the plugin; without one nothing is subscribed, and messages are given to :meth:`take`.
    :param topic: of diagnostic_msgs/DiagnosticArray; /diagnostics_agg without.
    """

    _received = Signal(object)

    def __init__(self, context=None, topic=None):
        super().__init__()
        self._topic = topic or "/diagnostics_agg"
        self.setObjectName("RobotMonitor")
        self.setWindowTitle("Diagnostics Viewer")
        self._history: deque[Any] = deque(maxlen=HISTORY)
        self._looking_at = None  # a message of the past; None: the newest
        self._heard = None  # s
        self.trees: dict[str, QTreeWidget] = {}
        self.splitter = QSplitter(Qt.Orientation.Vertical)
        for name, title in (("errors", "Error Device"), ("warnings", "Warned Device"), ("all", "All devices")):
            tree = QTreeWidget()
            tree.setObjectName(f"{name}_tree")
            tree.setHeaderLabels((title, "Message"))
            tree.setColumnWidth(0, 260)
            tree.itemDoubleClicked.connect(lambda item, column: self.inspect(item.data(0, Qt.ItemDataRole.UserRole)))
            self.trees[name] = tree
            self.splitter.addWidget(tree)
            EmptyText(tree, _EMPTY[name])
        self.splitter.setSizes([80, 80, 300])
        self.timeline, self.pause_button, self.status_label = Timeline(), QPushButton("Pause"), QLabel()
        self.timeline.chosen.connect(self.look_at)
        self.pause_button.setObjectName("pause_button")
        self.pause_button.clicked.connect(lambda: self.look_at(None if self._looking_at else len(self._history) - 1))
        self.status_label.setObjectName("status_label")
        low, layout = QHBoxLayout(), QVBoxLayout(self)
        low.addWidget(self.timeline, 1)
        low.addWidget(self.pause_button)
        layout.addWidget(self.splitter)
        layout.addLayout(low)
        layout.addWidget(self.status_label)
        self._inspectors = {}
        self._timer = QTimer(self)
        self._timer.timeout.connect(lambda: self.tell_age(time.monotonic()))
        self._timer.start(1000)
        self.tell_age(time.monotonic())
        self._received.connect(self.take)
        self._subscriber = None
        if context is not None:
            self._subscriber = rospy.Subscriber(self._topic, DiagnosticArray, self._received.emit, queue_size=10)

    def sizeHint(self) -> QSize:
        return QSize(650, 560)

    def shutdown(self) -> None:
        """Hear and tell no more."""
        self._timer.stop()
        if self._subscriber is not None:
            self._subscriber.unregister()
            self._subscriber = None

    def save_settings(self, plugin_settings, instance_settings) -> None:
        """Store the place of the splitter in ``instance_settings``; ``plugin_settings`` are left alone."""
        instance_settings.set_value("splitter", self.splitter.saveState())

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        """Put the splitter where ``instance_settings`` have it; ``plugin_settings`` are not read."""
        if instance_settings.contains("splitter"):
            self.splitter.restoreState(instance_settings.value("splitter"))

    def take(self, message) -> None:
        """A DiagnosticArray has come."""
        self._heard = time.monotonic()
        self._history.append(message)
        if self._looking_at is not None and not any(message is self._looking_at for message in self._history):
            self._looking_at = self._history[0]  # what was looked at has gone by
        self._show()

    def look_at(self, number) -> None:
        """A message of the timeline; None: what comes."""
        self._looking_at = self._history[number] if number is not None and 0 <= number < len(self._history) else None
        self.pause_button.setText("Resume" if self._looking_at else "Pause")
        self._show()

    def tell_age(self, now: float) -> None:
        """:param now: s"""
        if self._heard is None:
            self.status_label.setText(f"no message on {self._topic} yet; is diagnostic_aggregator running?")
        elif now - self._heard > SILENCE:
            self.status_label.setText(f"all of it is stale: the last message came {now - self._heard:.0f} s ago")
        else:
            self.status_label.setText(f"the last message came {now - self._heard:.0f} s ago")

    def _show(self) -> None:
        message = self._looking_at or (self._history[-1] if self._history else None)
        number = next((n for n, kept in enumerate(self._history) if kept is message), -1)
        self.timeline.show_levels([worst(kept.status) for kept in self._history], number)
        if message is None:
            return
        statuses = {status.name: status for status in message.status}
        self._fill(
            self.trees["errors"], {n: s for n, s in statuses.items() if known_level(s.level) in (DiagnosticStatus.ERROR, STALE)}, False
        )
        self._fill(self.trees["warnings"], {n: s for n, s in statuses.items() if s.level == DiagnosticStatus.WARN}, False)
        self._fill(self.trees["all"], statuses, True)
        for name, text in self._inspectors.items():
            if name in statuses:
                text.setPlainText(details(statuses[name]))

    def _fill(self, tree: QTreeWidget, statuses, nested: bool) -> None:
        """Rows by name, below each other if ``nested``; rows that were there stay unfolded and selected."""
        rows = {}

        def collect(item):
            for n in range(item.childCount()):
                rows[item.child(n).data(0, Qt.ItemDataRole.UserRole)] = item.child(n)
                collect(item.child(n))

        collect(tree.invisibleRootItem())
        for name in sorted(rows, key=len, reverse=True):
            if name not in statuses and not any(other.startswith(name + "/") for other in statuses if nested):
                item = rows.pop(name)
                (item.parent() or tree.invisibleRootItem()).removeChild(item)
        for name in sorted(statuses):
            item = self._row(tree, rows, name, nested)
            _, color, icon = LEVELS[known_level(statuses[name].level)]
            item.setText(1, statuses[name].message)
            item.setIcon(0, QIcon.fromTheme(icon))
            item.setForeground(0, QColor(color).darker(130))

    def _row(self, tree, rows, name: str, nested: bool):
        if name not in rows:
            above, _, last = name.rpartition("/")
            parent = self._row(tree, rows, above, True) if nested and above else tree.invisibleRootItem()
            rows[name] = QTreeWidgetItem([last if nested else name, ""])
            rows[name].setData(0, Qt.ItemDataRole.UserRole, name)
            parent.addChild(rows[name])
        return rows[name]

    def inspect(self, name: str) -> QDialog:
        """A window with all that a status says, kept up to date."""
        dialog, text = QDialog(self), QPlainTextEdit()
        dialog.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        dialog.setWindowTitle(name)
        dialog.resize(450, 350)
        text.setObjectName("status_text")
        text.setReadOnly(True)
        QVBoxLayout(dialog).addWidget(text)
        self._inspectors[name] = text
        dialog.finished.connect(lambda _: self._inspectors.pop(name, None))
        self._show()
        dialog.show()
        return dialog


def details(status) -> str:
    pairs = "\n".join(f"{pair.key}: {pair.value}" for pair in status.values)
    return (
        f"Full Name: {status.name}\nComponent: {status.name.rpartition('/')[2]}\nHardware ID: {status.hardware_id}\n"
        f"Level: {LEVELS[known_level(status.level)][0]}\nMessage: {status.message}\n\n{pairs}"
    )
