"""The plugin: the nodes of a rosmon, with a menu to start, stop and restart them."""

import re
from collections import deque
from typing import Any

import rospy
from python_qt_binding.QtCore import Qt, QTimer
from python_qt_binding.QtGui import QBrush, QColor
from python_qt_binding.QtWidgets import (
    QAbstractItemView,
    QComboBox,
    QHBoxLayout,
    QLabel,
    QMenu,
    QPushButton,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)
from rosmon_msgs.msg import NodeState, State
from rosmon_msgs.srv import StartStop, StartStopRequest
from rqt_gui_py.plugin import Plugin
from rqt_py_common.background import Background
from rqt_py_common.empty_text import EmptyText

PERIOD = 250  # ms between two looks at what has come
LOOK = 2000  # ms between two looks for rosmons
CALL = 5.0  # s that a rosmon may take to answer
COLUMNS = ("Node", "Namespace", "State", "Restarts", "CPU Load", "Memory")
_STATES = {
    NodeState.IDLE: ("idle", None),
    NodeState.RUNNING: ("running", "#8ae234"),
    NodeState.CRASHED: ("crashed", "#ef2929"),
    NodeState.WAITING: ("waiting", "#fce94f"),
}
_ACTIONS = {"Start": StartStopRequest.START, "Stop": StartStopRequest.STOP, "Restart": StartStopRequest.RESTART}


class _Cell(QTableWidgetItem):
    """Sorted by what it stands for, not by its text."""

    def __init__(self, text: str, value):
        super().__init__(text)
        self.value = value

    def __lt__(self, other) -> bool:
        return self.value < other.value


class Rosmon(Plugin):
    """One rosmon at a time is listened to: that of the combo box."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("ROSMon")
        self._background = Background(self)
        self._queue: deque[Any] = deque(maxlen=1)
        self._subscriber, self._shown, self._wanted = None, "", ""
        self.nodes = {}  # full name -> NodeState
        self._widget = self._build()
        number = context.serial_number()
        self._widget.setWindowTitle("ROSMon" + (f" ({number})" if number > 1 else ""))
        context.add_widget(self._widget)
        self._timers = []
        for period, work in ((PERIOD, self.update), (LOOK, self.look)):
            timer = QTimer(self)
            timer.timeout.connect(work)
            timer.start(period)
            self._timers.append(timer)
        self.look()

    def _build(self) -> QWidget:
        widget = QWidget()
        widget.setObjectName("ROSMonWidget")
        self.combo, self.table, self.line = QComboBox(), QTableWidget(0, len(COLUMNS)), QLabel()
        self.combo.setObjectName("rosmon_combo")
        self.combo.setToolTip("The topics of rosmons: those of type rosmon_msgs/State")
        self.combo.currentTextChanged.connect(self._listen)
        self.table.setObjectName("node_table")
        EmptyText(self.table, "No rosmon runs: mon launch PACKAGE FILE.launch")
        self.table.setHorizontalHeaderLabels(COLUMNS)
        self.table.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.table.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.table.setSortingEnabled(True)
        self.table.sortByColumn(0, Qt.SortOrder.AscendingOrder)
        self.table.verticalHeader().hide()
        self.table.setMinimumSize(680, 240)
        self.table.setColumnWidth(0, 180)
        self.table.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.table.customContextMenuRequested.connect(lambda place: self._menu().exec(self.table.viewport().mapToGlobal(place)))
        self.line.setObjectName("message_label")
        self.line.setWordWrap(True)
        top = QHBoxLayout()
        top.addWidget(self.combo, 1)
        for name in _ACTIONS:
            button = QPushButton(name)
            button.setObjectName(name.lower() + "_button")
            button.setToolTip(f"{name} the chosen nodes")
            button.clicked.connect(lambda _=False, name=name: self.act(name))
            top.addWidget(button)
        layout = QVBoxLayout(widget)
        layout.addLayout(top)
        layout.addWidget(self.table)
        layout.addWidget(self.line)
        return widget

    def _menu(self) -> QMenu:
        menu = QMenu(self.table)
        for name in _ACTIONS:
            menu.addAction(name, lambda name=name: self.act(name))
        return menu

    def look(self) -> None:
        """For rosmons, in the background: the master may hang."""
        self._background.run(
            "topics",
            lambda: sorted(topic for topic, kind in rospy.get_published_topics() if kind == State._type),
            self._found,
            lambda error: self.line.setText(f"The master does not answer: {error}"),
        )

    def _found(self, topics) -> None:
        # One that ended stays chosen, empty, until it is there again.
        names = sorted({*topics, *filter(None, [self._shown])})
        if [self.combo.itemText(n) for n in range(self.combo.count())] != names:
            chosen = self._wanted if self._wanted in names else self._shown
            self.combo.blockSignals(True)
            self.combo.clear()
            self.combo.addItems(names)
            self.combo.setCurrentIndex(max(0, self.combo.findText(chosen)))
            self.combo.blockSignals(False)
        self._listen(self.combo.currentText())
        if not names:
            self.line.setText("No rosmon runs: start one with mon launch.")
        elif self._shown not in topics:
            self.line.setText(f"{self._shown}: this rosmon has ended.")
        elif self.line.text().startswith("No rosmon") or self.line.text().endswith("has ended."):
            self.line.clear()

    def _listen(self, topic: str) -> None:
        if topic == self._shown:
            return
        if self._subscriber:
            self._subscriber.unregister()
        self._queue.clear()
        self._shown = topic
        self.show_nodes([])
        self._subscriber = rospy.Subscriber(topic, State, self._queue.append, queue_size=1) if topic else None

    def update(self) -> None:
        if self._queue:
            self.show_nodes(self._queue.popleft().nodes)

    def show_nodes(self, nodes) -> None:
        """Fill the table; what was chosen stays chosen."""
        chosen = self.chosen()
        self.nodes = {f"{node.ns.rstrip('/')}/{node.name}": node for node in nodes}
        self.table.setSortingEnabled(False)
        self.table.setRowCount(len(self.nodes))
        for row, (name, node) in enumerate(self.nodes.items()):
            state, colour = _STATES.get(node.state, (str(node.state), None))
            load = node.user_load + node.system_load
            for column, (text, value) in enumerate(
                (
                    (node.name, name),
                    (node.ns or "/", node.ns),
                    (state, state),
                    (str(node.restart_count), node.restart_count),
                    (f"{100 * load:.0f} %", load),
                    (f"{node.memory / 2**20:.0f} MiB", node.memory),
                )
            ):
                cell = _Cell(text, value)
                if column == 2 and colour:
                    cell.setBackground(QBrush(QColor(colour)))
                    cell.setForeground(QBrush(QColor("black")))
                self.table.setItem(row, column, cell)
                cell.setSelected(name in chosen)
        self.table.setSortingEnabled(True)

    def chosen(self):
        """Full names of the chosen nodes, sorted."""
        return sorted({self.table.item(item.row(), 0).value for item in self.table.selectedItems()})

    def act(self, name: str) -> None:
        """Start, Stop or Restart the chosen nodes."""
        names = self.chosen()
        if not names:
            self.line.setText("Choose nodes in the table first.")
            return
        service = self._shown.rsplit("/", 1)[0] + "/start_stop"

        def call():
            rospy.wait_for_service(service, CALL)
            for full in names:
                node = self.nodes[full]
                rospy.ServiceProxy(service, StartStop)(re.escape(node.name), re.escape(node.ns), _ACTIONS[name])

        self.line.setText(f"{name}: {', '.join(names)}")
        self._background.run(("act", name, *names), call, None, lambda error: self.line.setText(f"{name}: {error}"))

    def shutdown_plugin(self) -> None:
        for timer in self._timers:
            timer.stop()
        self._background.close()
        if self._subscriber:
            self._subscriber.unregister()

    def save_settings(self, plugin_settings, instance_settings) -> None:
        instance_settings.set_value("rosmon", self._shown)

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        self._wanted = str(instance_settings.value("rosmon", ""))
