"""libgazebo_ros_prosilica.so: a camera that streams, or gives one picture for each request."""

from __future__ import annotations

import threading
from typing import Any

import rospy
from gazebo_ros.names import join
from gazebo_ros.plugin import PluginError
from node_signals import offers
from ode_sim_rendering import Frame
from polled_camera.srv import GetPolledImage, GetPolledImageResponse
from sensor_msgs.msg import CameraInfo, Image
from std_msgs.msg import Header

from gazebo_plugins.cameras.camera import Camera

_TIMEOUT = 5.0  # s of wall time for one picture; a service that never answers is worse than one that refuses


class Prosilica(Camera):
    """The parameter ``trigger_mode`` (searched upwards from the camera's namespace) is ``streaming``, the default, or
    ``polled``: then the service ``<pollServiceName>`` (default ``request_image``) publishes one picture per call on the
    topics ``<response_namespace>/image_raw`` and ``camera_info``."""

    def load(self, server, sensor, sdf) -> None:
        super().load(server, sensor, sdf)
        self._server, self._service = server, None
        self._publishers: dict[str, Any] = {}
        namespace = self.camera.namespace
        mode = self._mode(namespace)
        if mode not in ("streaming", "polled"):
            self.shutdown()
            raise PluginError(f"parameter trigger_mode is '{mode}'; use streaming or polled")
        self._streams = mode == "streaming"
        if not self._streams:
            name = join(namespace, sdf.text_or("pollServiceName", "request_image"))
            self._service = offers.service(name, GetPolledImage, self._poll)

    @staticmethod
    def _mode(namespace: str) -> str:
        parts = namespace.strip("/").split("/")
        for depth in range(len(parts), -1, -1):
            value = rospy.get_param("/" + "/".join(parts[:depth] + ["trigger_mode"]), None)
            if value is not None:
                return str(value)
        return "streaming"

    def wanted(self) -> bool:
        return self._streams and super().wanted()

    def _poll(self, request) -> GetPolledImageResponse:
        """Service thread."""
        if request.binning_x > 1 or request.binning_y > 1:
            return GetPolledImageResponse(success=False, status_message="binning is not supported; use 0 or 1")
        roi, camera = request.roi, self.camera.camera
        if any((roi.x_offset, roi.y_offset)) or roi.width not in (0, camera.width) or roi.height not in (0, camera.height):
            return GetPolledImageResponse(success=False, status_message="a region of interest is not supported; leave it 0")
        image_topic, info_topic = self._topics(request.response_namespace)
        header = Header(stamp=self._server.now(), frame_id=self.camera.frame_id)
        taken = threading.Event()

        def arrived(header: Header, frame: Frame) -> None:
            data = bytes(frame.data["image"])  # a latched message outlives the frame
            image_topic.publish(Image(header, camera.height, camera.width, camera.encoding, 0, len(data) // camera.height, data))
            info_topic.publish(self.camera.info(header))
            taken.set()

        self._server.call(lambda: self.camera.shoot(header, ("image",), arrived))
        if not taken.wait(_TIMEOUT):
            return GetPolledImageResponse(success=False, status_message="the camera gives no picture; see the simulator's log")
        return GetPolledImageResponse(success=True, stamp=header.stamp)

    def _topics(self, namespace: str):
        """Publishers of a response namespace, latched: the caller may subscribe only after the answer."""
        if namespace not in self._publishers:
            base = join(self.camera.namespace, namespace)
            self._publishers[namespace] = (
                rospy.Publisher(f"{base}/image_raw", Image, queue_size=2, latch=True),
                rospy.Publisher(f"{base}/camera_info", CameraInfo, queue_size=2, latch=True),
            )
        return self._publishers[namespace]

    def shutdown(self) -> None:
        if self._service is not None:
            self._service.shutdown("the camera is gone")
        for publishers in self._publishers.values():
            for publisher in publishers:
                publisher.unregister()
        super().shutdown()
