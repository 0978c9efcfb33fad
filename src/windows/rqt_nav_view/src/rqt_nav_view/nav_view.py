"""The picture with its buttons, and the dialog of its topics."""

from __future__ import annotations

import threading
from collections.abc import Sequence

import rosgraph
import tf2_ros
from python_qt_binding.QtCore import Qt, Signal, qWarning
from python_qt_binding.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QListWidget,
    QListWidgetItem,
    QPushButton,
    QVBoxLayout,
    QWidget,
)
from rqt_py_common.ini_helper import pack, unpack

from rqt_nav_view.map_view import NavView

MAP_TOPIC = "/map"
PATHS = ["/move_base/NavFn/plan", "/move_base/TrajectoryPlannerROS/local_plan"]
POLYGONS = ["/move_base/local_costmap/robot_footprint"]
_TYPES = {"nav_msgs/OccupancyGrid": "map", "nav_msgs/Path": "paths", "geometry_msgs/PolygonStamped": "polygons"}


class _TopicDialog(QDialog):
    """Asks for the topics. :param found: kind -> topics that there are. :param chosen: kind -> topics that are shown."""

    def __init__(self, found, chosen, parent):
        super().__init__(parent)
        self.setWindowTitle("Navigation Viewer")
        self.map = QComboBox()
        self.map.setEditable(True)
        self.map.addItems(sorted(set(found["map"]) | set(chosen["map"])))
        self.map.setCurrentText(chosen["map"][0])
        form = QFormLayout(self)
        form.addRow("Map", self.map)
        self.lists = {}
        for kind in ("paths", "polygons"):
            self.lists[kind] = QListWidget()
            for name in sorted(set(found[kind]) | set(chosen[kind])):
                item = QListWidgetItem(name, self.lists[kind])
                item.setCheckState(Qt.CheckState.Checked if name in chosen[kind] else Qt.CheckState.Unchecked)
            form.addRow(kind.capitalize(), self.lists[kind])
        box = QDialogButtonBox(QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel)
        box.accepted.connect(self.accept)
        box.rejected.connect(self.reject)
        form.addRow(box)

    def checked(self, kind: str) -> list[str]:
        items = [self.lists[kind].item(row) for row in range(self.lists[kind].count())]
        return [item.text() for item in items if item.checkState() == Qt.CheckState.Checked]


class NavViewWidget(QWidget):
    """A map with paths and polygons; buttons set the robot's pose and its goal. Names of topics; those of move_base without."""

    _topics_found = Signal(object)

    def __init__(self, map_topic: str = MAP_TOPIC, paths: Sequence[str] = PATHS, polygons: Sequence[str] = POLYGONS):
        super().__init__()
        self.setObjectName("NavView")
        self.setWindowTitle("Navigation Viewer")
        self.map_topic, self.paths, self.polygons = map_topic, list(paths), list(polygons)
        self._tf = tf2_ros.Buffer(debug=False)  # its service of debugging can be there but once in a node
        self._listener = tf2_ros.TransformListener(self._tf)
        self.view: NavView | None = None
        buttons = QHBoxLayout()
        for name, text, action in (
            ("set_pose", "Set Pose", lambda: self.view and self.view.pose_mode()),
            ("set_goal", "Set Goal", lambda: self.view and self.view.goal_mode()),
        ):
            button = QPushButton(text)
            button.setObjectName(name)
            button.setToolTip("Press the mouse at the place, drag towards the heading")
            button.clicked.connect(lambda _checked=False, action=action: action())
            buttons.addWidget(button)
        self._layout = QVBoxLayout(self)
        self._layout.addLayout(buttons)
        self._new_view()
        self._topics_found.connect(self._ask)

    def _new_view(self) -> None:
        if self.view is not None:
            self.view.shutdown()
            self._layout.removeWidget(self.view)
            self.view.deleteLater()
        self.view = NavView(self.map_topic, self.paths, self.polygons, self._tf)
        self._layout.addWidget(self.view, 1)

    def ask_topics(self) -> None:
        """Ask which topics are to be shown."""

        def look() -> None:
            found: dict[str, list[str]] = {"map": [], "paths": [], "polygons": []}
            try:
                for name, kind in rosgraph.Master("/rqt_nav_view").getTopicTypes():
                    if kind in _TYPES:
                        found[_TYPES[kind]].append(name)
            except (rosgraph.MasterException, OSError) as error:
                qWarning(f"rqt_nav_view: the master does not answer: {error}")
            self._topics_found.emit(found)

        threading.Thread(target=look, daemon=True).start()

    def _ask(self, found) -> None:
        chosen = {"map": [self.map_topic], "paths": self.paths, "polygons": self.polygons}
        self._dialog = dialog = _TopicDialog(found, chosen, self)
        dialog.accepted.connect(lambda: self.show_topics(dialog.map.currentText(), dialog.checked("paths"), dialog.checked("polygons")))
        dialog.open()

    def show_topics(self, map_topic: str, paths: list[str], polygons: list[str]) -> None:
        """Show other topics: ``map_topic``, and all of ``paths`` and ``polygons``."""
        self.map_topic, self.paths, self.polygons = map_topic, paths, polygons
        self._new_view()

    def save_settings(self, plugin_settings, instance_settings) -> None:
        """Store the names of the topics in ``instance_settings``; ``plugin_settings`` are left alone."""
        instance_settings.set_value("map_topic", self.map_topic)
        instance_settings.set_value("paths", pack(self.paths))
        instance_settings.set_value("polygons", pack(self.polygons))

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        """Show the topics that ``instance_settings`` have, if they have any; ``plugin_settings`` are not read."""
        if instance_settings.contains("map_topic"):
            self.show_topics(
                str(instance_settings.value("map_topic")),
                list(unpack(instance_settings.value("paths", [])) or []),
                list(unpack(instance_settings.value("polygons", [])) or []),
            )

    def shutdown(self) -> None:
        """Let go of topics; the widget is of no use afterwards."""
        if self._listener is not None:
            if self.view is not None:
                self.view.shutdown()
            self._listener.unregister()
            self._listener = None

    def closeEvent(self, event) -> None:
        self.shutdown()
        super().closeEvent(event)
