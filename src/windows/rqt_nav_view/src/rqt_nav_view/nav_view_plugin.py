"""The plugin Navigation Viewer of rqt."""
from __future__ import annotations

import threading
from typing import List

import rosgraph
import tf2_ros
from python_qt_binding.QtCore import Qt, Signal, qWarning
from python_qt_binding.QtWidgets import (QComboBox, QDialog, QDialogButtonBox, QFormLayout, QHBoxLayout, QListWidget, QListWidgetItem,
                                         QPushButton, QVBoxLayout, QWidget)
from rqt_gui_py.plugin import Plugin
from rqt_py_common.ini_helper import pack, unpack

from rqt_nav_view.nav_view import NavView

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

    def checked(self, kind: str) -> List[str]:
        items = [self.lists[kind].item(row) for row in range(self.lists[kind].count())]
        return [item.text() for item in items if item.checkState() == Qt.CheckState.Checked]


class NavViewPlugin(Plugin):
    """A map with paths and polygons; buttons set the robot's pose and its goal."""

    _topics_found = Signal(object)

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("NavViewPlugin")
        self.map_topic, self.paths, self.polygons = MAP_TOPIC, list(PATHS), list(POLYGONS)
        self._tf = tf2_ros.Buffer(debug=False)  # its service of debugging can be there but once in a node
        self._listener = tf2_ros.TransformListener(self._tf)
        self.view = None
        self._widget = QWidget()
        number = context.serial_number()
        self._widget.setObjectName("NavView")
        self._widget.setWindowTitle("Navigation Viewer" + (f" ({number})" if number > 1 else ""))
        buttons = QHBoxLayout()
        for name, text, action in (("set_pose", "Set Pose", lambda: self.view.pose_mode()),
                                   ("set_goal", "Set Goal", lambda: self.view.goal_mode())):
            button = QPushButton(text)
            button.setObjectName(name)
            button.setToolTip("Press the mouse at the place, drag towards the heading")
            button.clicked.connect(lambda _checked=False, action=action: action())
            buttons.addWidget(button)
        self._layout = QVBoxLayout(self._widget)
        self._layout.addLayout(buttons)
        self._new_view()
        self._topics_found.connect(self._ask)
        context.add_widget(self._widget)

    def _new_view(self) -> None:
        if self.view is not None:
            self.view.shutdown()
            self._layout.removeWidget(self.view)
            self.view.deleteLater()
        self.view = NavView(self.map_topic, self.paths, self.polygons, self._tf)
        self._layout.addWidget(self.view, 1)

    def trigger_configuration(self) -> None:
        """Ask which topics are to be shown."""
        def look() -> None:
            found = {"map": [], "paths": [], "polygons": []}
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
        self._dialog = dialog = _TopicDialog(found, chosen, self._widget)
        dialog.accepted.connect(lambda: self.show_topics(dialog.map.currentText(), dialog.checked("paths"), dialog.checked("polygons")))
        dialog.open()

    def show_topics(self, map_topic: str, paths: List[str], polygons: List[str]) -> None:
        """Show other topics."""
        self.map_topic, self.paths, self.polygons = map_topic, paths, polygons
        self._new_view()

    def save_settings(self, plugin_settings, instance_settings) -> None:
        instance_settings.set_value("map_topic", self.map_topic)
        instance_settings.set_value("paths", pack(self.paths))
        instance_settings.set_value("polygons", pack(self.polygons))

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        if instance_settings.contains("map_topic"):
            self.show_topics(str(instance_settings.value("map_topic")), list(unpack(instance_settings.value("paths", [])) or []),
                             list(unpack(instance_settings.value("polygons", [])) or []))

    def shutdown_plugin(self) -> None:
        self.view.shutdown()
        self._listener.unregister()
