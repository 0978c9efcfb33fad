"""The plot with its tool bar: which topics, pause, autoscroll, clear."""

from __future__ import annotations

import time
from typing import Any

import rospy
from python_qt_binding.QtCore import Qt, QTimer, Slot, qWarning
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import QCheckBox, QHBoxLayout, QLabel, QLineEdit, QMenu, QPushButton, QToolButton, QVBoxLayout, QWidget
from rqt_py_common.topic_completer import TopicCompleter

from rqt_plot.fields import FieldError, expand, parse_path
from rqt_plot.rosplot import ROSData, RosPlotException, TopicTypes, topic_types

_CLOCK_SET_BACK = 1.0  # s: stamps that are older than this are no jitter


def get_plot_fields(topic_name: str, types: dict[str, str] | None = None) -> tuple[list[str], str]:
    """Names of the curves that ``topic_name`` stands for, and a sentence about them.

    :param types: topic -> type of its messages; the master is asked without
    """
    try:
        names, message = expand(topic_name, topic_types() if types is None else types)
    except RosPlotException as error:
        names, message = [], str(error)
    return names or [], message


def is_plottable(topic_name: str) -> tuple[bool, str]:
    """Whether a name can be plotted now, and why not."""
    fields, message = get_plot_fields(topic_name)
    return bool(fields), message


def could_appear(name: str) -> bool:
    """Whether a topic of this name may still come: a global name whose parts are legal."""
    try:
        return name.startswith("/") and not name.endswith("/") and bool(parse_path(name))
    except FieldError:
        return False


class PlotWidget(QWidget):
    """Plots topics into a `DataPlot`, given by :meth:`switch_data_plot_widget`.

    :param initial_topics: names to begin with; topics that do not exist yet are waited for. :param start_paused: show nothing
        new until the pause button is released.
    """

    _redraw_interval = 40  # ms

    def __init__(self, initial_topics: list[str] | None = None, start_paused: bool = False):
        super().__init__()
        self.setObjectName("PlotWidget")
        self.setAcceptDrops(True)
        self._initial_topics = initial_topics
        self.data_plot: Any = None  # a DataPlot, or what others bring in its place
        self._build()
        self.pause_button.setChecked(start_paused)
        self._start_time = rospy.get_time()
        self._rosdata: dict[str, ROSData] = {}
        self._waiting: list[str] = []  # names whose topics do not exist yet
        self._newest: dict[str, float] = {}
        self._told: set = set()
        self._topics = TopicTypes()
        self._remove_topic_menu = QMenu(self)
        self._update_plot_timer = QTimer(self)
        self._update_plot_timer.timeout.connect(self.update_plot)
        self._look_timer = QTimer(self)
        self._look_timer.timeout.connect(self._look_for_topics)
        self._look_timer.start(500)
        self.destroyed.connect(self._topics.close)

    def _build(self) -> None:
        def button(icon: str, tip: str, checkable: bool = False, fallback: str = "") -> QPushButton:
            made = QPushButton(QIcon.fromTheme(icon), "" if QIcon.hasThemeIcon(icon) else fallback)
            made.setToolTip(tip)
            made.setCheckable(checkable)
            return made

        self.topic_edit = QLineEdit("/")
        self.topic_edit.setObjectName("topic_edit")
        self._topic_completer = TopicCompleter(self.topic_edit)
        self.topic_edit.setCompleter(self._topic_completer)
        self.subscribe_topic_button = button("list-add", "Plot this topic", fallback="+")
        self.subscribe_topic_button.setEnabled(False)
        self.remove_topic_button = QToolButton()
        self.remove_topic_button.setIcon(QIcon.fromTheme("list-remove"))
        self.remove_topic_button.setText("-")
        self.remove_topic_button.setToolTip("Remove a curve")
        self.remove_topic_button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self.autoscroll_checkbox = QCheckBox("autoscroll")
        self.autoscroll_checkbox.setChecked(True)
        self.pause_button = button("media-playback-pause", "Pause: nothing is drawn, nothing is lost", True, "Pause")
        self.clear_button = button("edit-clear", "Forget the samples", fallback="Clear")
        self.waiting_label = QLabel()
        self.waiting_label.setObjectName("waiting_label")
        self.waiting_label.setTextFormat(Qt.TextFormat.PlainText)
        self.waiting_label.hide()
        bar = QHBoxLayout()
        bar.addWidget(QLabel("Topic"))
        bar.addWidget(self.topic_edit, 1)
        for name in ("subscribe_topic_button", "remove_topic_button", "autoscroll_checkbox", "pause_button", "clear_button"):
            widget = getattr(self, name)
            widget.setObjectName(name)
            bar.addWidget(widget)
        self.data_plot_layout = QVBoxLayout()
        layout = QVBoxLayout(self)
        layout.addLayout(bar)
        layout.addLayout(self.data_plot_layout, 1)
        layout.addWidget(self.waiting_label)
        self.topic_edit.textChanged.connect(self.on_topic_edit_textChanged)
        self.topic_edit.returnPressed.connect(self.on_topic_edit_returnPressed)
        self.subscribe_topic_button.clicked.connect(self.on_subscribe_topic_button_clicked)
        self.autoscroll_checkbox.clicked.connect(self.on_autoscroll_checkbox_clicked)
        self.pause_button.clicked.connect(self.on_pause_button_clicked)
        self.clear_button.clicked.connect(self.on_clear_button_clicked)

    def switch_data_plot_widget(self, data_plot) -> None:
        """Draw into ``data_plot`` from now on; the one before it is closed."""
        self.enable_timer(False)
        if self.data_plot is not None:
            self.data_plot_layout.removeWidget(self.data_plot)
            self.data_plot.close()
        self.data_plot = data_plot
        self.data_plot_layout.addWidget(data_plot)
        data_plot.autoscroll(self.autoscroll_checkbox.isChecked())
        names, self._initial_topics = self._initial_topics or [], None
        for name in names:
            self.add_topic(name)
        for name, rosdata in self._rosdata.items():
            if not names:
                data_plot.add_curve(name, name, *rosdata.next())
        self._subscribed_topics_changed()

    # Which topics

    def add_topic(self, topic_name: str) -> None:
        """Plot what a name stands for, as soon as its topic exists."""
        types = self._topics.types
        if expand(topic_name, types)[0] is None:
            try:
                types = topic_types()
            except RosPlotException as error:
                qWarning(f"rqt_plot: {error}")
        names, message = expand(topic_name, types)
        if names is None:
            if could_appear(topic_name) and topic_name not in self._waiting:
                self._waiting.append(topic_name)
                self._show_waiting()
            elif not could_appear(topic_name):
                qWarning(f"rqt_plot: '{topic_name}' is no name of a topic")
            return
        if not names:
            qWarning(f"rqt_plot: {message}")
        for name in names:
            self._add_curve(name, types)
        self._subscribed_topics_changed()

    def _add_curve(self, name: str, types: dict[str, str]) -> None:
        if name in self._rosdata:
            qWarning(f"rqt_plot: {name} is plotted already")
            return
        rosdata = ROSData(name, self._start_time, types)
        if rosdata.error is not None:
            qWarning(f"rqt_plot: {rosdata.error}")
            return
        self._rosdata[name] = rosdata
        self.data_plot.add_curve(name, name, *rosdata.next())

    def _look_for_topics(self) -> None:
        types = self._topics.types
        found = [name for name in self._waiting if expand(name, types)[0] is not None]
        for name in found:
            self._waiting.remove(name)
            self.add_topic(name)
        if found:
            self._show_waiting()
        if self.topic_edit.text() not in ("", "/"):
            self._judge(self.topic_edit.text())

    def _show_waiting(self) -> None:
        self.waiting_label.setText("waiting for " + ", ".join(self._waiting))
        self.waiting_label.setVisible(bool(self._waiting))
        self._update_remove_topic_menu()

    def topics(self) -> list[str]:
        """Names of all curves, those included that wait for their topic."""
        return list(self._rosdata) + self._waiting

    def remove_topic(self, topic_name: str) -> None:
        """Remove a curve, or stop waiting for it."""
        if topic_name in self._waiting:
            self._waiting.remove(topic_name)
        else:
            self._rosdata.pop(topic_name).close()
            self._newest.pop(topic_name, None)
            self._told.discard(topic_name)
            self.data_plot.remove_curve(topic_name)
        self._show_waiting()
        self._subscribed_topics_changed()

    def clean_up_subscribers(self) -> None:
        """Remove all curves."""
        for name in self.topics():
            self.remove_topic(name)

    def shutdown(self) -> None:
        """Stop timers, threads and subscriptions; the widget is of no use afterwards."""
        self._look_timer.stop()
        self.enable_timer(False)
        self._topics.close()
        for rosdata in self._rosdata.values():
            rosdata.close()
        self._rosdata = {}

    def _subscribed_topics_changed(self) -> None:
        self._update_remove_topic_menu()
        if not self.pause_button.isChecked():
            self.enable_timer(bool(self._rosdata))
        self.data_plot.redraw()

    def _update_remove_topic_menu(self) -> None:
        self._remove_topic_menu.clear()
        names = sorted(self.topics())
        for name in names:
            self._remove_topic_menu.addAction(name).triggered.connect(lambda _checked=False, name=name: self.remove_topic(name))
        if len(names) > 1:
            self._remove_topic_menu.addAction("All").triggered.connect(lambda _checked=False: self.clean_up_subscribers())
        self.remove_topic_button.setMenu(self._remove_topic_menu)

    # New values

    def update_plot(self) -> None:
        """Take over what came since the last call, and draw it."""
        started = time.monotonic()
        arrived = {}
        for name, rosdata in self._rosdata.items():
            if rosdata.problem and name not in self._told:
                self._told.add(name)
                qWarning(f"rqt_plot: {rosdata.problem}")
            try:
                data_x, data_y = rosdata.next()
            except RosPlotException as error:
                qWarning(f"rqt_plot: {error}")
                continue
            if data_x:
                arrived[name] = data_x, data_y
        if not arrived or self.data_plot is None:
            return
        if any(max(x) < self._newest.get(name, -1e300) - _CLOCK_SET_BACK for name, (x, _) in arrived.items()):
            self.clear_plot()  # a bag or a simulation that starts again: its past would lie in the future
        for name, (x, y) in arrived.items():
            self._newest[name] = max(x)
            self.data_plot.update_values(name, x, y)
        self.data_plot.redraw()
        # A machine that cannot draw so fast still has to hear its user: at most half of the time is for drawing.
        spent = 1000 * (time.monotonic() - started)
        self._update_plot_timer.setInterval(int(max(self._redraw_interval, 2 * spent)))

    def clear_plot(self) -> None:
        """Forget the samples of all curves."""
        self._newest.clear()
        for name in self._rosdata:
            self.data_plot.clear_values(name)
        self.data_plot.redraw()

    def enable_timer(self, enabled: bool = True) -> None:
        if enabled:
            self._update_plot_timer.start(self._redraw_interval)
        else:
            self._update_plot_timer.stop()

    # What the user does

    def _judge(self, name: str) -> None:
        names, message = expand(name, self._topics.types)
        if names is None and could_appear(name):
            message += " yet; its curve starts when it appears"
        self.subscribe_topic_button.setEnabled(bool(names) or names is None and could_appear(name))
        self.subscribe_topic_button.setToolTip(message)

    @Slot(str)
    def on_topic_edit_textChanged(self, topic_name: str) -> None:
        if topic_name in ("", "/"):
            self._topics.refresh()
            self._topic_completer.update_topics()
        self._judge(topic_name)

    @Slot()
    def on_topic_edit_returnPressed(self) -> None:
        if self.subscribe_topic_button.isEnabled():
            self.add_topic(self.topic_edit.text())

    @Slot()
    def on_subscribe_topic_button_clicked(self) -> None:
        self.add_topic(self.topic_edit.text())

    @Slot(bool)
    def on_pause_button_clicked(self, checked: bool) -> None:
        self.enable_timer(not checked)

    @Slot(bool)
    def on_autoscroll_checkbox_clicked(self, checked: bool) -> None:
        self.data_plot.autoscroll(checked)
        if checked:
            self.data_plot.redraw()

    @Slot()
    def on_clear_button_clicked(self) -> None:
        self.clear_plot()

    @staticmethod
    def _dragged(event) -> str:
        """Name of the topic that is dragged: plain text, or the item of a tree that carries it as Topic Monitor's do."""
        if event.mimeData().hasText():
            return event.mimeData().text()
        items = event.source().selectedItems() if hasattr(event.source(), "selectedItems") else []
        return str(items[0].data(0, Qt.ItemDataRole.UserRole) or "") if items else ""

    def dragEnterEvent(self, event) -> None:
        names, message = get_plot_fields(self._dragged(event), self._topics.types)
        if names:
            event.acceptProposedAction()
        else:
            qWarning(f"rqt_plot: not taken: {message}")

    def dropEvent(self, event) -> None:
        self.add_topic(self._dragged(event))
