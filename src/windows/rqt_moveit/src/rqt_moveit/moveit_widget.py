"""The tables and the tree of topics."""

from __future__ import annotations

from python_qt_binding.QtCore import Qt, QTimer
from python_qt_binding.QtGui import QColor
from python_qt_binding.QtWidgets import (
    QAbstractItemView,
    QHBoxLayout,
    QHeaderView,
    QLabel,
    QSpinBox,
    QSplitter,
    QTableWidget,
    QTableWidgetItem,
    QVBoxLayout,
    QWidget,
)
from rqt_py_common.background import Background
from rqt_topic.topic_widget import TopicWidget

from rqt_moveit.presence import NODES, PARAMETERS, SENSOR_TYPES, Presence, look

_PERIOD = 5  # s, as upstream's
_SPLITTER = "splitter_horizontal"
_RATE = "refresh_rate"
_THERE, _GONE = QColor("#1f7a1f"), QColor("#b02020")


class _Table(QTableWidget):
    """Names, and a word for each that says whether it is there."""

    def __init__(self, name: str, labels: tuple[str, str], names: tuple[str, ...], words: tuple[str, str]):
        """:param words: for what is there and for what is not"""
        super().__init__(len(names), 2)
        self.setObjectName(name)
        self._words = words
        self.setHorizontalHeaderLabels(labels)
        self.horizontalHeader().setSectionResizeMode(0, QHeaderView.ResizeMode.ResizeToContents)
        self.horizontalHeader().setStretchLastSection(True)
        self.verticalHeader().setVisible(False)
        self.setAlternatingRowColors(True)
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self._rows = {}
        for row, text in enumerate(names):
            self.setItem(row, 0, QTableWidgetItem(text))
            self._rows[text] = QTableWidgetItem("")
            self.setItem(row, 1, self._rows[text])

    def show_reasons(self, reasons: dict[str, str]) -> None:
        """:param reasons: of each name why it is not there; empty if it is"""
        for name, reason in reasons.items():
            item = self._rows[name]
            item.setText(self._words[1] if reason else self._words[0])
            item.setForeground(_GONE if reason else _THERE)
            item.setToolTip(reason)


class MoveitWidget(QWidget):
    """Looks at once and then every few seconds, in the background."""

    def __init__(self):
        super().__init__()
        self.setObjectName("MoveitWidget")
        self.setWindowTitle("Moveit! Monitor")
        self._background = Background(self)
        self._nodes = _Table("_view_nodes", ("Node name", "Running?"), NODES, ("Running", "Not running"))
        self._params = _Table("_view_params", ("Param name", "Found on Parameter Server?"), PARAMETERS, ("Yes", "No"))
        self._topics = TopicWidget(selected_topics=list(SENSOR_TYPES), select_topic_type=TopicWidget.SELECT_BY_MSGTYPE)
        self._topics.empty_text.set_text("No topics of point clouds, images or camera_info: MoveIt sees what it is told of only.")
        self._status = QLabel()
        self._status.setObjectName("status_label")
        self._status.setWordWrap(True)
        self._build(self._make_rate())
        self._timer = QTimer(self)
        self._timer.timeout.connect(self.refresh)
        self._timer.start(_PERIOD * 1000)
        self._topics.start()
        self.refresh()

    def _make_rate(self) -> QSpinBox:
        self._rate = QSpinBox()
        self._rate.setObjectName("_spinbox_refreshrate")
        self._rate.setRange(1, 99)
        self._rate.setSuffix(" s")
        self._rate.setToolTip("Nodes and parameters are looked at as often; topics every second.")
        self._rate.setValue(_PERIOD)
        self._rate.valueChanged.connect(self._set_period)
        return self._rate

    def _build(self, rate: QSpinBox) -> None:
        tables = QSplitter(Qt.Orientation.Horizontal)
        tables.addWidget(self._nodes)
        tables.addWidget(self._params)
        tables.setSizes([200, 360])
        self._splitter = QSplitter(Qt.Orientation.Vertical)
        self._splitter.setObjectName("_splitter")
        self._splitter.addWidget(tables)
        self._splitter.addWidget(self._topics)
        self._splitter.setSizes([150, 250])
        bar = QHBoxLayout()
        bar.addWidget(self._status, 1)
        bar.addWidget(QLabel("Refresh rate"))
        bar.addWidget(rate)
        layout = QVBoxLayout(self)
        layout.addWidget(self._splitter, 1)
        layout.addLayout(bar)

    def _set_period(self, seconds: int) -> None:
        self._timer.start(seconds * 1000)
        self.refresh()

    def refresh(self) -> None:
        self._background.run("look", look, self._show, self._no_master)

    def _show(self, presence: Presence) -> None:
        self._nodes.show_reasons(presence.nodes)
        self._params.show_reasons(presence.parameters)
        reasons = [reason for part in presence for reason in part.values() if reason]
        self._status.setText(reasons[0] if reasons else "")

    def _no_master(self, error: Exception) -> None:
        text = f"the master does not answer: is roscore running? ({error})"
        self._show(Presence(dict.fromkeys(NODES, text), dict.fromkeys(PARAMETERS, text)))

    def save_settings(self, settings) -> None:
        settings.set_value(_SPLITTER, self._splitter.saveState())
        settings.set_value(_RATE, self._rate.value())

    def restore_settings(self, settings) -> None:
        if settings.contains(_SPLITTER):
            self._splitter.restoreState(settings.value(_SPLITTER))
        self._rate.setValue(int(settings.value(_RATE, _PERIOD)))

    def shutdown(self) -> None:
        self._timer.stop()
        self._background.close()
        self._topics.shutdown_plugin()
