"""3D perception: sensors that see the surroundings."""

from typing import Any

from python_qt_binding.QtWidgets import QStackedWidget, QWidget

from moveit_setup_assistant.screens.base import Screen, choice, form_layout, line

_KINDS: dict[str, dict[str, Any]] = {
    "Point Cloud": {
        "sensor_plugin": "occupancy_map_monitor/PointCloudOctomapUpdater",
        "point_cloud_topic": "/head_mount_kinect/depth_registered/points",
        "max_range": 5.0,
        "point_subsample": 1,
        "padding_offset": 0.1,
        "padding_scale": 1.0,
        "max_update_rate": 1.0,
        "filtered_cloud_topic": "filtered_cloud",
    },
    "Depth Map": {
        "sensor_plugin": "occupancy_map_monitor/DepthImageOctomapUpdater",
        "image_topic": "/head_mount_kinect/depth_registered/image_raw",
        "queue_size": 5,
        "near_clipping_plane_distance": 0.3,
        "far_clipping_plane_distance": 5.0,
        "shadow_threshold": 0.2,
        "padding_offset": 0.03,
        "padding_scale": 4.0,
        "max_update_rate": 1.0,
        "filtered_cloud_topic": "filtered_cloud",
    },
}


class PerceptionScreen(Screen):
    """One sensor for the octomap; further ones are written into sensors_3d.yaml by hand, and kept."""

    title = "3D Perception"
    about = "A depth camera or a laser fills the octomap, so that the robot plans around what it sees."

    def __init__(self, session) -> None:
        super().__init__(session)
        self._kind = choice(("None", *_KINDS))
        self._kind.setObjectName("perception_kind")
        form = form_layout()
        form.addRow("Sensor", self._kind)
        self.layout_.addLayout(form)
        self._stack = QStackedWidget()
        self._fields: dict[str, Any] = {}
        self._stack.addWidget(QWidget())
        for kind, values in _KINDS.items():
            page = QWidget()
            form = form_layout(page)
            fields = self._fields[kind] = {}
            for key, value in list(values.items())[1:]:
                fields[key] = line(str(value))
                fields[key].setObjectName(f"perception_{key}")
                form.addRow(key.replace("_", " ").capitalize(), fields[key])
            self._stack.addWidget(page)
        self._kind.currentIndexChanged.connect(self._stack.setCurrentIndex)
        self._kind.currentTextChanged.connect(self._fill)
        self.layout_.addWidget(self._stack)
        self.layout_.addStretch(1)

    def enter(self) -> None:
        kind = next((k for k, v in _KINDS.items() if v["sensor_plugin"] == self._first().get("sensor_plugin")), "None")
        self._kind.setCurrentText(kind)
        self._fill(kind)

    def leave(self):
        kind, others = self._kind.currentText(), self.config.sensors[1:]
        known = self._first().get("sensor_plugin") in [values["sensor_plugin"] for values in _KINDS.values()]
        if kind == "None":
            self.config.sensors = others if known else self.config.sensors
            return None
        defaults = _KINDS[kind]
        same = self._first().get("sensor_plugin") == defaults["sensor_plugin"]
        sensor: dict[str, Any] = {**(self._first() if same else {}), "sensor_plugin": defaults["sensor_plugin"]}
        for key, field in self._fields[kind].items():
            try:
                sensor[key] = type(defaults[key])(field.text().strip())
            except ValueError:
                return f"3D Perception: '{field.text()}' is no number for {key.replace('_', ' ')}."
        self.config.sensors = [sensor, *others]
        return None

    def _first(self) -> dict[str, Any]:
        return self.config.sensors[0] if self.config.sensors else {}

    def _fill(self, kind: str) -> None:
        same = self._first().get("sensor_plugin") == _KINDS.get(kind, {}).get("sensor_plugin")
        for key, field in self._fields.get(kind, {}).items():
            field.setText(str((self._first() if same else {}).get(key, _KINDS[kind][key])))
