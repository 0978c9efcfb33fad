"""libgazebo_ros_multicamera.so: the two cameras of a ``<sensor type="multicamera">`` as a stereo pair."""

from __future__ import annotations

from gazebo_ros.names import join
from gazebo_ros.plugin import PluginError, SensorPlugin

from gazebo_plugins.cameras.ros_camera import RosCamera, node_namespace

_SIDES = ("left", "right")


class Multicamera(SensorPlugin):
    """Topics in cameraName/left and cameraName/right; both pictures are of the same moment. ``<hackBaseline>`` shows in
    the right camera's P only, as the stereo nodes want it."""

    def load(self, server, sensor, sdf) -> None:
        elements = sensor.description.element.findall("camera")
        by_side = {side: [e for e in elements if side in e.get("name", "")] for side in _SIDES}
        if len(elements) != 2 or any(len(found) != 1 for found in by_side.values()):
            names = ", ".join(f"'{e.get('name', '')}'" for e in elements) or "none"
            raise PluginError(
                f"sensor '{sensor.name}' needs exactly two cameras, one with 'left' and one with 'right' in its name; it has: {names}"
            )
        namespace = node_namespace(sensor, sdf)
        self.cameras: list[RosCamera] = []
        try:
            for side, (element,) in by_side.items():
                self.cameras.append(
                    RosCamera(server, sensor, sdf, element, join(namespace, side), baseline=0.0 if side == "left" else None)
                )
        except PluginError:
            self.shutdown()  # the left one may already be there
            raise
        sensor.connect(self.measure, wanted=self.wanted)

    def wanted(self) -> bool:
        return any(camera.wanted() for camera in self.cameras)

    def measure(self, sensor) -> None:
        if self.cameras[0].gate.due(sensor.measurement_ns):
            for camera in self.cameras:
                camera.take()

    def reset(self) -> None:
        for camera in self.cameras:
            camera.gate.reset()

    def shutdown(self) -> None:
        for camera in self.cameras:
            camera.shutdown()
