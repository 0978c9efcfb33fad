"""The plugin Pose View of rqt."""

from __future__ import annotations

import math

import numpy as np
import roslib.message
import rospy
from python_qt_binding.QtCore import Qt, QTimer, Signal, qWarning
from python_qt_binding.QtWidgets import QHBoxLayout, QLabel, QLineEdit, QVBoxLayout, QWidget
from rqt_gui_py.plugin import Plugin

from rqt_pose_view.pose_widget import PoseWidget
from rqt_pose_view.poses import quaternion_path, reader, rotation

_PERIOD = 40  # ms


class _Window(QWidget):
    """A line for the topic over the view; topics can be dropped on it."""

    dropped = Signal(str)

    def __init__(self):
        super().__init__()
        self.setObjectName("PoseView")
        self.setWindowTitle("Pose View")
        self.setAcceptDrops(True)
        self.topic = QLineEdit()
        self.topic.setObjectName("topic")
        self.topic.setPlaceholderText("/odom, or drop a topic of Topic Monitor here")
        self.pose = PoseWidget()
        bar = QHBoxLayout()
        bar.addWidget(QLabel("Topic"))
        bar.addWidget(self.topic)
        layout = QVBoxLayout(self)
        layout.addLayout(bar)
        layout.addWidget(self.pose, 1)

    @staticmethod
    def _dragged(event) -> str:
        if event.mimeData().hasText():
            return event.mimeData().text()
        items = event.source().selectedItems() if hasattr(event.source(), "selectedItems") else []
        return str(items[0].data(0, Qt.ItemDataRole.UserRole) or "") if items else ""

    def dragEnterEvent(self, event) -> None:
        if self._dragged(event):
            event.acceptProposedAction()

    def dropEvent(self, event) -> None:
        self.dropped.emit(self._dragged(event))


class PoseView(Plugin):
    """The orientation in messages of a topic: a Quaternion, or the first one in a Pose, Odometry, Imu, Transform ..."""

    _failed = Signal(str, str)

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("PoseView")
        self._subscriber = None
        self._topic = ""
        self._readers: dict = {}
        self._newest = None
        self._told: set = set()
        self._widget = _Window()
        number = context.serial_number()
        if number > 1:
            self._widget.setWindowTitle(f"Pose View ({number})")
        context.add_widget(self._widget)
        self._failed.connect(self._tell)
        self._widget.dropped.connect(self.show_topic)
        self._widget.topic.returnPressed.connect(lambda: self.show_topic(self._widget.topic.text()))
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._draw)
        self._timer.start(_PERIOD)
        if rospy.has_param("~pose_view_topic"):
            self.show_topic(str(rospy.get_param("~pose_view_topic")))

    def show_topic(self, topic: str) -> None:
        """Show a topic; it need not exist yet, and may be of any type with a quaternion in it."""
        if self._subscriber is not None:
            self._subscriber.unregister()
            self._subscriber = None
        self._topic, self._newest = topic.strip(), None
        self._widget.topic.setText(self._topic)
        if not self._topic:
            return
        self._widget.pose.set_rotation(np.eye(3), f"waiting for {self._topic}")
        try:
            name = rospy.resolve_name(self._topic)
            self._subscriber = rospy.Subscriber(name, rospy.AnyMsg, lambda raw: self._receive(topic.strip(), raw), queue_size=1)
        except (ValueError, rospy.ROSException) as error:
            self._tell(self._topic, f"'{self._topic[:60]}' is no name of a topic: {error}")

    def _receive(self, topic: str, raw) -> None:
        kind = raw._connection_header["type"]
        if kind not in self._readers:
            message_class = roslib.message.get_message_class(kind)
            path = quaternion_path(message_class) if message_class else None
            self._readers[kind] = (message_class, reader(path)) if path is not None else None
        if self._readers[kind] is None:
            self._failed.emit(topic, f"{topic} is of type {kind}, which has no quaternion outside of arrays, or is not built here")
            return
        message_class, read = self._readers[kind]
        try:
            self._newest = topic, read(message_class().deserialize(raw._buff))
        except Exception as error:  # genpy raises many kinds for bytes that are cut short
            self._failed.emit(topic, f"{topic}: broken message: {str(error)[:80]}")

    def _tell(self, topic: str, text: str) -> None:
        if topic == self._topic:
            self._widget.pose.set_rotation(None, text)
            if text not in self._told:
                self._told.add(text)
                qWarning(f"rqt_pose_view: {text}")

    def _draw(self) -> None:
        newest, self._newest = self._newest, None
        if newest is None or newest[0] != self._topic:
            return
        matrix = rotation(newest[1])
        if matrix is None:
            self._widget.pose.set_rotation(None, "this quaternion is no rotation: (%g, %g, %g, %g)" % newest[1])
            return
        roll, yaw = math.atan2(matrix[2, 1], matrix[2, 2]), math.atan2(matrix[1, 0], matrix[0, 0])
        pitch = math.asin(min(max(-matrix[2, 0], -1.0), 1.0))
        degrees = tuple(round(math.degrees(angle), 1) + 0.0 for angle in (roll, pitch, yaw))  # + 0.0: never "-0.0"
        self._widget.pose.set_rotation(matrix, "roll %.1f\u00b0  pitch %.1f\u00b0  yaw %.1f\u00b0" % degrees)

    def save_settings(self, plugin_settings, instance_settings) -> None:
        camera = self._widget.pose.camera
        instance_settings.set_value("topic", self._topic)
        instance_settings.set_value("view", f"{camera.azimuth} {camera.elevation} {camera.distance}")

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        try:
            view = [float(part) for part in str(instance_settings.value("view", "") or "").split()]
        except ValueError:
            view = []
        if len(view) == 3 and all(map(math.isfinite, view)):
            camera = self._widget.pose.camera
            camera.azimuth, camera.elevation, camera.distance = view
        topic = str(instance_settings.value("topic", "") or "")
        if topic and not self._topic:
            self.show_topic(topic)

    def shutdown_plugin(self) -> None:
        self._timer.stop()
        if self._subscriber is not None:
            self._subscriber.unregister()
