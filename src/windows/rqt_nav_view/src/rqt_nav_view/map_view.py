"""The picture: a map, what is drawn on it, and the mouse that sets poses."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import rospy
import tf2_ros
from geometry_msgs.msg import PolygonStamped, PoseStamped, PoseWithCovarianceStamped
from nav_msgs.msg import OccupancyGrid, Path
from python_qt_binding.QtCore import QPointF, Qt, Signal, qWarning
from python_qt_binding.QtGui import QColor, QImage, QPainter, QPainterPath, QPen, QPixmap, QPolygonF
from python_qt_binding.QtWidgets import QGraphicsScene, QGraphicsView

from rqt_nav_view.geometry import MapError, map_pixels, points_of, quaternion_of, transformed, yaw

_COLORS = [
    QColor(*rgb) for rgb in ((238, 34, 116), (68, 134, 252), (200, 180, 20), (60, 180, 18), (242, 156, 6), (240, 64, 10), (196, 30, 250))
]
#: variances of the pose that is set: x, y in m^2, yaw in rad^2
_COVARIANCE = {0: 0.25, 7: 0.25, 35: 0.06853891945200942}


class NavView(QGraphicsView):
    """Shows a map in metres, y up, and lines in its frame.

    :param tf_buffer: knows the frames of paths and polygons.
    """

    _map_came = Signal(object, object)
    _line_came = Signal(str, object)
    _failed = Signal(str)

    def __init__(self, map_topic: str, paths: list[str], polygons: list[str], tf_buffer: tf2_ros.Buffer, parent=None):
        super().__init__(parent)
        self.setObjectName("nav_view")
        self.setDragMode(QGraphicsView.DragMode.ScrollHandDrag)
        self.setRenderHint(QPainter.RenderHint.Antialiasing)
        self.setTransformationAnchor(QGraphicsView.ViewportAnchor.AnchorUnderMouse)
        self.scale(20, -20)  # pixels per metre
        self._scene = QGraphicsScene(self)
        self.setScene(self._scene)
        self._tf = tf_buffer
        self.frame_id = ""
        self._map_item: Any = None  # the map's QGraphicsPixmapItem
        self._lines: dict[str, object] = {}
        self._mode = ""
        self._pressed: QPointF | None = None
        self._arrow = None
        self._told: set = set()
        self._map_came.connect(self._show_map)
        self._line_came.connect(self._show_line)
        self._failed.connect(self._tell)
        self._publishers = {
            "pose": rospy.Publisher("/initialpose", PoseWithCovarianceStamped, queue_size=100),
            "goal": rospy.Publisher("/move_base_simple/goal", PoseStamped, queue_size=100),
        }
        self._subscribers = [rospy.Subscriber(map_topic, OccupancyGrid, self.map_cb)]
        for name, kind in [(name, Path) for name in paths] + [(name, PolygonStamped) for name in polygons]:
            self._lines[name] = None
            self._subscribers.append(rospy.Subscriber(name, kind, lambda message, name=name: self.line_cb(name, message), queue_size=1))
        self._colors = {name: _COLORS[number % len(_COLORS)] for number, name in enumerate(self._lines)}

    def shutdown(self) -> None:
        """Let go of topics."""
        for connection in self._subscribers + list(self._publishers.values()):
            connection.unregister()

    # Messages, in rospy's threads

    def map_cb(self, message) -> None:
        try:
            self._map_came.emit(map_pixels(message), message)
        except MapError as error:
            self._failed.emit(str(error))

    def line_cb(self, name: str, message) -> None:
        """Show the path or polygon of ``message``, in rospy's thread; ``name`` is its topic."""
        points, frame = points_of(message), message.header.frame_id.lstrip("/")
        if frame and self.frame_id and frame != self.frame_id:
            try:
                points = transformed(points, self._tf.lookup_transform(self.frame_id, frame, rospy.Time(0)).transform)
            except tf2_ros.TransformException as error:
                self._failed.emit(f"{name} is not shown: {error}")
                return
        self._line_came.emit(name, points[:, :2])

    # The scene

    def _tell(self, text: str) -> None:
        key = text.partition(":")[0]
        if key not in self._told:
            self._told.add(key)
            qWarning(f"rqt_nav_view: {text}")

    def _show_map(self, pixels: np.ndarray, message) -> None:
        first = self._map_item is None
        if not first:
            self._scene.removeItem(self._map_item)
        image = QImage(
            np.ascontiguousarray(pixels).data, pixels.shape[1], pixels.shape[0], pixels.shape[1], QImage.Format.Format_Grayscale8
        )
        self._map_item = self._scene.addPixmap(QPixmap.fromImage(image))
        origin, resolution = message.info.origin, message.info.resolution
        self._map_item.setZValue(-1)
        self._map_item.setPos(origin.position.x, origin.position.y)
        self._map_item.setRotation(math.degrees(yaw(origin.orientation)))
        self._map_item.setScale(resolution)
        self.frame_id = message.header.frame_id.lstrip("/")
        self._scene.setSceneRect(self._map_item.sceneBoundingRect())
        if first:
            self.fitInView(self._map_item, Qt.AspectRatioMode.KeepAspectRatio)

    def _show_line(self, name: str, points: np.ndarray) -> None:
        if self._lines.get(name) is not None:
            self._scene.removeItem(self._lines[name])
            self._lines[name] = None
        if len(points):
            path = QPainterPath(QPointF(*points[0]))
            for point in points[1:]:
                path.lineTo(QPointF(*point))
            pen = QPen(self._colors[name], 2)
            pen.setCosmetic(True)
            self._lines[name] = self._scene.addPath(path, pen)

    # The mouse

    def pose_mode(self) -> None:
        """The next drag says where the robot is."""
        self._begin("pose")

    def goal_mode(self) -> None:
        """The next drag says where the robot is to go."""
        self._begin("goal")

    def _begin(self, mode: str) -> None:
        self._mode = mode
        self.setDragMode(QGraphicsView.DragMode.NoDrag)
        self.viewport().setCursor(Qt.CursorShape.CrossCursor)

    def wheelEvent(self, event) -> None:
        factor = 1.15 ** (event.angleDelta().y() / 120)
        self.scale(factor, factor)

    def mousePressEvent(self, event) -> None:
        if self._mode and event.button() == Qt.MouseButton.LeftButton:
            self._pressed = self.mapToScene(event.pos())
        else:
            super().mousePressEvent(event)

    def mouseMoveEvent(self, event) -> None:
        if self._pressed is None:
            super().mouseMoveEvent(event)
            return
        self._remove_arrow()
        end = self.mapToScene(event.pos())
        angle = math.atan2(end.y() - self._pressed.y(), end.x() - self._pressed.x())
        length = 40 / abs(self.transform().m11() or 1.0)
        tip = [
            (length, 0),
            (0.6 * length, 0.2 * length),
            (0.6 * length, 0.05 * length),
            (0, 0.05 * length),
            (0, -0.05 * length),
            (0.6 * length, -0.05 * length),
            (0.6 * length, -0.2 * length),
        ]
        corners = [
            QPointF(
                self._pressed.x() + x * math.cos(angle) - y * math.sin(angle), self._pressed.y() + x * math.sin(angle) + y * math.cos(angle)
            )
            for x, y in tip
        ]
        self._arrow = self._scene.addPolygon(QPolygonF(corners), QPen(Qt.PenStyle.NoPen), QColor("red"))

    def _remove_arrow(self) -> None:
        if self._arrow is not None:
            self._scene.removeItem(self._arrow)
            self._arrow = None

    def mouseReleaseEvent(self, event) -> None:
        if self._pressed is None:
            super().mouseReleaseEvent(event)
            return
        begin, end, mode = self._pressed, self.mapToScene(event.pos()), self._mode
        self._remove_arrow()
        self._pressed, self._mode = None, ""
        self.setDragMode(QGraphicsView.DragMode.ScrollHandDrag)
        self._publish(mode, begin, math.atan2(end.y() - begin.y(), end.x() - begin.x()))

    def _publish(self, mode: str, place: QPointF, angle: float) -> None:
        message = PoseWithCovarianceStamped() if mode == "pose" else PoseStamped()
        message.header.frame_id, message.header.stamp = self.frame_id or "map", rospy.Time.now()
        pose = message.pose.pose if mode == "pose" else message.pose
        pose.position.x, pose.position.y = place.x(), place.y()
        pose.orientation.z, pose.orientation.w = quaternion_of(angle)
        if mode == "pose":
            covariance = [0.0] * 36
            for index, value in _COVARIANCE.items():
                covariance[index] = value
            message.pose.covariance = covariance
        self._publishers[mode].publish(message)
