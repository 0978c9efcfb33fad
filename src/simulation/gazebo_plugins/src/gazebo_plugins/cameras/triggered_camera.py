"""libgazebo_ros_triggered_camera.so and libgazebo_ros_triggered_multicamera.so: one picture per trigger message."""

from __future__ import annotations

import threading

import rospy
from gazebo_ros.names import join
from std_msgs.msg import Empty

from gazebo_plugins.cameras.camera import Camera
from gazebo_plugins.cameras.multicamera import Multicamera
from gazebo_plugins.cameras.ros_camera import node_namespace


class _Trigger:
    """Counts std_msgs/Empty messages on ``<triggerTopicName>`` in the camera's namespace."""

    def __init__(self, namespace: str, sdf):
        self._count = 0
        self._lock = threading.Lock()
        self._subscriber = rospy.Subscriber(
            join(namespace, sdf.text_or("triggerTopicName", "image_trigger")), Empty, self._pull, queue_size=100
        )

    def _pull(self, _message) -> None:
        with self._lock:
            self._count += 1

    def pending(self) -> bool:
        """A trigger is waiting for its picture."""
        return self._count > 0

    def take(self) -> None:
        with self._lock:
            self._count -= 1

    def shutdown(self) -> None:
        self._subscriber.unregister()


class TriggeredCamera(Camera):
    """The picture is taken in the next step, whatever the sensor's rate; without a listener the trigger is used up
    too."""

    def load(self, server, sensor, sdf) -> None:
        super().load(server, sensor, sdf)
        self.trigger = _Trigger(self.camera.namespace, sdf)
        sensor.update_rate.rate = 0.0

    def wanted(self) -> bool:
        return self.trigger.pending()

    def measure(self, sensor) -> None:
        self.trigger.take()
        self.camera.take()

    def shutdown(self) -> None:
        self.trigger.shutdown()
        super().shutdown()


class TriggeredMulticamera(Multicamera):
    """Both cameras at once."""

    def load(self, server, sensor, sdf) -> None:
        super().load(server, sensor, sdf)
        self.trigger = _Trigger(node_namespace(sensor, sdf), sdf)
        sensor.update_rate.rate = 0.0

    def wanted(self) -> bool:
        return self.trigger.pending()

    def measure(self, sensor) -> None:
        self.trigger.take()
        for camera in self.cameras:
            camera.take()

    def shutdown(self) -> None:
        self.trigger.shutdown()
        super().shutdown()
