"""What all camera plugins share: one simulated camera with its topics, parameters and services."""

from __future__ import annotations

import copy
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import rospy
from dynamic_parameters import Parameter
from dynamic_parameters import Server as ParameterServer
from gazebo_ros.names import join, resolve_frame, robot_namespace, tf_prefix
from gazebo_ros.plugin import PluginError
from gazebo_ros.rate_watch import RateWatch
from gazebo_ros.studio import Shooting
from node_signals.rates import Spaced
from ode_sim_rendering import ENCODINGS, Camera, CameraError, Frame, read_camera
from sensor_msgs.msg import CameraInfo
from std_msgs.msg import Header

from gazebo_plugins.cameras.camera_info import CameraInfoService, camera_info, read_calibration
from gazebo_plugins.cameras.image_topics import ImageTopics
from gazebo_plugins.ros_side import told_namespace

_RATE = (Parameter("imager_rate", float, 2.0, 1.0, 50.0, "Frame rate of the sensor, Hz of sim time"),)


def camera_of(sensor, sdf, element) -> Camera:
    """The camera of ``element``, a ``<camera>`` of ``sensor``; ``sdf`` is the plugin's element.

    :raises PluginError: values that no camera can have, in one line naming the sensor.
    """
    if element is None:
        raise PluginError(f"sensor '{sensor.name}' has no <camera> element")
    given = (element.findtext("image/format") or "R8G8B8").strip()
    try:
        camera = read_camera(
            element,
            sensor.description.pose,
            sensor.link.scoped_name,
            f"{sensor.scoped_name}::{element.get('name', '')}",
            image_format=given if given in ENCODINGS else "B8G8R8",
            wide=sensor.description.type == "wideanglecamera",
        )
    except CameraError as error:
        raise PluginError(f"sensor '{sensor.name}': {error}") from None
    if given not in ENCODINGS:
        rospy.logerr(
            "sensor '%s' of model '%s': unknown image format '%s', bgr8 is published; known: %s",
            sensor.name,
            sensor.model.name,
            given,
            ", ".join(ENCODINGS),
        )
    return replace(camera, distortion=replace(camera.distortion, crop=sdf.get("borderCrop", True)))


def node_namespace(sensor, sdf) -> str:
    """Absolute namespace of the topics of the camera of ``sensor`` and plugin element ``sdf``: robotNamespace/cameraName."""
    return join(robot_namespace(sdf, sensor.model.name, "B"), sdf.get("cameraName", "")).rstrip("/")


class RosCamera:
    """One camera: image and camera_info topics, imager_rate, set_camera_info. Made and used in the physics thread.

    :param namespace: absolute, of its topics. :param baseline: m, for P[3].
    :param depth_range: m, outside of which a depth is invalid.
    """

    def __init__(
        self, server, sensor, sdf, element, namespace: str, baseline: float | None = None, depth_range: tuple[float, float] = (0.0, np.inf)
    ):
        self.sensor = sensor
        self.namespace = namespace
        self.camera = camera_of(sensor, sdf, element)
        self.queue_size = 2
        calibration = read_calibration(sdf, self.camera)
        self._check_focal_length(calibration.focal_length)
        prefix = tf_prefix(robot_namespace(sdf, sensor.model.name, "B"))
        given = told_namespace(sdf, sensor.model.name, "Camera")
        rospy.loginfo('Camera Plugin (ns = %s)  <tf_prefix_>, set to "%s"', given, prefix)
        if not sdf.get("cameraName", ""):
            rospy.logwarn(
                "dynamic reconfigure is not enabled for this image topic [%s] becuase <cameraName> is not specified",
                sdf.text_or("imageTopicName", "image_raw"),
            )  # upstream's spelling
        self.frame_id = resolve_frame(prefix, sdf.get("frameName", ""))
        #: the plugin's own ``<updateRate>``
        self._plugin_rate = sdf.get("updateRate", 0.0)
        self.gate = Spaced(self._plugin_rate)
        self._watch = RateWatch()
        self._world = server.world
        self._closed = False
        self._shooting = Shooting(server, self.camera, f"camera '{sensor.name}' of model '{sensor.model.name}'", depth_range)
        name = sdf.text_or("cameraName", sensor.name)
        info = camera_info(self.camera, calibration, calibration.baseline if baseline is None else baseline)
        self._info_service = CameraInfoService(namespace, name.strip("/").replace("/", "_"), info)
        self._info = rospy.Publisher(
            join(namespace, sdf.text_or("cameraInfoTopicName", "camera_info")), CameraInfo, queue_size=self.queue_size
        )
        self.image = ImageTopics(
            join(namespace, sdf.text_or("imageTopicName", "image_raw")),
            self.camera.encoding,
            (self.camera.height, self.camera.width),
            self.queue_size,
        )
        self._rate = ParameterServer(namespace, _RATE, self._set_rate) if sdf.get("cameraName", "") else None

    def _check_focal_length(self, given: float) -> None:
        if given and abs(given - self.camera.focal_length) > 1e-8:
            rospy.logwarn(
                "sensor '%s' of model '%s': <focalLength> %g does not fit width %d and horizontal_fov %g, "
                "which give %g; camera_info carries %g, the picture is drawn with the field of view",
                self.sensor.name,
                self.sensor.model.name,
                given,
                self.camera.width,
                self.camera.hfov,
                self.camera.focal_length,
                given,
            )

    def _set_rate(self, config, level: int) -> None:
        if level != -1:  # the default is not the user's wish: the sensor's own rate holds until somebody changes it
            self.sensor.update_rate.rate = config["imager_rate"]

    # ------------------------------------------------------------------------------------------ pictures

    def wanted(self) -> bool:
        """Somebody listens to an image or to camera_info."""
        return bool(self._info.get_num_connections() or self.image.outputs())

    def header(self) -> Header:
        """Of a picture taken at the sensor's newest update."""
        return Header(stamp=self.sensor.measurement_time, frame_id=self.frame_id)

    def take(self) -> None:
        """Take one picture of now and publish what somebody listens to; image and camera_info share the stamp."""

        def arrived(header: Header, frame: Frame) -> None:
            self.image.publish(header, frame)
            self.publish_info(header)

        outputs = self.image.outputs()
        if outputs:
            self.shoot(self.header(), outputs, arrived)
        else:  # camera_info alone needs no picture
            self.publish_info(self.header())
            self.sensor.pictured(self.sensor.measurement_ns)

    def shoot(self, header: Header, outputs: tuple[str, ...], deliver: Callable[[Header, Frame], None]) -> None:
        """Have ``outputs`` (of the render process) of now; ``deliver(header, frame)`` is called in the pictures'
        thread."""
        measured_ns = self.sensor.measurement_ns

        def arrived(frame: Frame) -> None:
            if not self._closed:
                deliver(header, frame)
                self.sensor.pictured(measured_ns)

        taken = self._shooting.shoot(outputs, arrived)
        said = self._watch.asked(self.sensor.measurement_ns, taken, self.sensor.update_rate.rate, self._plugin_rate, self._world.dt)
        if said:
            rospy.logwarn("camera '%s' of model '%s' %s", self.sensor.name, self.sensor.model.name, said)

    def info(self, header: Header) -> CameraInfo:
        """camera_info with this header."""
        info = copy.copy(self._info_service.info)
        info.header = header
        return info

    def publish_info(self, header: Header) -> None:
        """Publish the camera_info with ``header``, while somebody listens."""
        if self._info.get_num_connections():
            self._info.publish(self.info(header))

    def shutdown(self) -> None:
        self._closed = True
        self._shooting.close()
        self._info_service.shutdown()
        self._info.unregister()
        self.image.shutdown()
        if self._rate is not None:
            self._rate.shutdown()
