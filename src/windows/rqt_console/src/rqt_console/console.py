"""The plugin: log messages of a topic, several thousand a second if need be."""

from collections import deque
from typing import Any

import rospy
from python_qt_binding.QtCore import QTimer
from python_qt_binding.QtWidgets import QDialog, QDialogButtonBox, QFormLayout, QSpinBox
from rosgraph_msgs.msg import Log
from rqt_gui_py.plugin import Plugin
from rqt_py_common.background import Background
from rqt_py_common.extended_combo_box import ExtendedComboBox

from .console_widget import ConsoleWidget
from .message import Message

FLUSH = 100  # ms between two looks into the queue
BATCH = 1000  # messages taken at once; the rest waits for the next look
LIMIT = 20000  # messages kept


class Console(Plugin):
    """Shows /rosout_agg, or any other topic of rosgraph_msgs/Log."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("Console")
        self._limit, self._topic, self._subscriber = LIMIT, "/rosout_agg", None
        self._queue: deque[Any] = deque(maxlen=LIMIT)
        self._widget = ConsoleWidget(message_limit=self._limit)
        if context.serial_number() > 1:
            self._widget.setWindowTitle(f"Console ({context.serial_number()})")
        context.add_widget(self._widget)
        self._background = Background(self)
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._flush)
        self._timer.start(FLUSH)
        self._values_timer = QTimer(self)
        self._values_timer.timeout.connect(self._refresh_values)
        self._values_timer.start(10 * FLUSH)
        self._subscribe(self._topic)

    @property
    def widget(self) -> ConsoleWidget:
        return self._widget

    @staticmethod
    def convert_rosgraph_log_message(log: Log) -> Message:
        """A rosgraph_msgs/Log as what MessageDataModel takes."""
        return Message.from_log(log)

    def queue_message(self, log: Log) -> None:
        """Called in rospy's thread."""
        self._queue.append(Message.from_log(log))

    def _refresh_values(self) -> None:
        self._widget.exclude_box.refresh()
        self._widget.highlight_box.refresh()

    def _flush(self) -> None:
        queue = self._queue
        self._widget.take([queue.popleft() for _ in range(min(BATCH, len(queue)))])

    def _subscribe(self, topic: str) -> None:
        self._unsubscribe()
        self._topic = topic
        self._subscriber = rospy.Subscriber(topic, Log, self.queue_message)

    def _unsubscribe(self) -> None:
        if self._subscriber is not None:
            self._subscriber.unregister()
            self._subscriber = None

    def trigger_configuration(self) -> None:
        dialog = QDialog(self._widget)
        dialog.setWindowTitle("Console")
        topics, limit = ExtendedComboBox(), QSpinBox()
        topics.addItem(self._topic)
        limit.setRange(1, 1000000)
        limit.setValue(self._limit)
        form = QFormLayout(dialog)
        form.addRow("Topic", topics)
        form.addRow("Messages kept", limit)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel)
        buttons.accepted.connect(dialog.accept)
        buttons.rejected.connect(dialog.reject)
        form.addRow(buttons)
        self._background.run(
            "topics", lambda: sorted(name for name, kind in rospy.get_published_topics() if kind == Log._type), topics.onSetItems
        )
        dialog.accepted.connect(lambda: self._configure(topics.currentText(), limit.value()))
        dialog.open()

    def _configure(self, topic: str, limit: int) -> None:
        if topic and topic != self._topic:
            self._subscribe(topic)
        self._limit = limit
        self._widget.model.set_message_limit(limit)

    def shutdown_plugin(self) -> None:
        self._unsubscribe()
        self._background.close()
        self._timer.stop()
        self._values_timer.stop()

    def save_settings(self, plugin_settings, instance_settings) -> None:
        instance_settings.set_value("topic", self._topic)
        instance_settings.set_value("message_limit", self._limit)
        self._widget.save_settings(plugin_settings, instance_settings)

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        try:
            limit = max(1, int(instance_settings.value("message_limit", LIMIT)))
        except (TypeError, ValueError):
            limit = LIMIT
        self._configure(instance_settings.value("topic", self._topic), limit)
        self._widget.restore_settings(plugin_settings, instance_settings)
