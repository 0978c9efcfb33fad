"""libgazebo_ros_camera.so: images of a ``<sensor type="camera">`` and their camera_info."""

from __future__ import annotations

from gazebo_ros.plugin import SensorPlugin

from gazebo_plugins.cameras.ros_camera import RosCamera, node_namespace


class Camera(SensorPlugin):
    """Publishes while somebody listens, at the sensor's rate, no faster than ``<updateRate>`` (Hz of sim time)."""

    def load(self, server, sensor, sdf) -> None:
        self.camera = RosCamera(server, sensor, sdf, sensor.description.element.find("camera"), node_namespace(sensor, sdf))
        sensor.connect(self.measure, wanted=self.wanted)

    def wanted(self) -> bool:
        return self.camera.wanted()

    def measure(self, sensor) -> None:
        if self.camera.gate.due(sensor.measurement_ns):
            self.camera.take()

    def reset(self) -> None:
        self.camera.gate.reset()

    def shutdown(self) -> None:
        self.camera.shutdown()
