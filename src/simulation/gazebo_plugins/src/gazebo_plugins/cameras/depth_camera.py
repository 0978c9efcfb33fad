"""libgazebo_ros_openni_kinect.so and libgazebo_ros_depth_camera.so: colour, depth and a point cloud of a
``<sensor type="depth">``."""

from __future__ import annotations

import numpy as np
import rospy
from gazebo_ros.names import join
from gazebo_ros.plugin import SensorPlugin
from ode_sim_rendering import Frame
from sensor_msgs.msg import CameraInfo, PointField
from std_msgs.msg import Header

from gazebo_plugins.cameras.image_message import PointCloud2
from gazebo_plugins.cameras.image_topics import ImageTopics
from gazebo_plugins.cameras.ros_camera import RosCamera, node_namespace

_FIELDS = [PointField(name, offset, PointField.FLOAT32, 1) for name, offset in (("x", 0), ("y", 4), ("z", 8), ("rgb", 16))]
_POINT_STEP = 32
_OF_GAZEBO_9 = ("reflectanceTopicName", "normalsTopicName", "reduceNormals")


class DepthCamera(SensorPlugin):
    """Depths nearer than ``<pointCloudCutoff>`` (m) are invalid; what is farther than the far clip lies on it. The
    cloud is one row of points."""

    organised = False

    def load(self, server, sensor, sdf) -> None:
        self.camera = camera = RosCamera(
            server, sensor, sdf, sensor.description.element.find("camera"), node_namespace(sensor, sdf), depth_range=self.depth_range(sdf)
        )
        millimetres = sdf.get("useDepth16UC1Format", False)
        self.depth = ImageTopics(
            join(camera.namespace, sdf.text_or("depthImageTopicName", "depth/image_raw")),
            "16UC1" if millimetres else "32FC1",
            (camera.camera.height, camera.camera.width),
            camera.queue_size,
            source="depth16" if millimetres else "depth",
            compressible=False,
        )
        self.depth_info = rospy.Publisher(
            join(camera.namespace, sdf.text_or("depthImageCameraInfoTopicName", "depth/camera_info")),
            CameraInfo,
            queue_size=camera.queue_size,
        )
        self.points = rospy.Publisher(
            join(camera.namespace, sdf.text_or("pointCloudTopicName", "points")), PointCloud2, queue_size=camera.queue_size
        )
        sensor.connect(self.measure, wanted=self.wanted)
        asked = [f"<{tag}>" for tag in _OF_GAZEBO_9 if sdf.has(tag)]
        if asked:
            rospy.logwarn(
                "sensor '%s' of model '%s': %s without effect: reflectances and normals are not published, as on Noetic's Gazebo 11 "
                "(Gazebo 9.13 did)",
                sensor.name,
                sensor.model.name,
                ", ".join(asked) + (" is" if len(asked) == 1 else " are"),
            )

    def depth_range(self, sdf):
        """(nearest, farthest) depth that is valid, m, by the plugin's element ``sdf``."""
        return sdf.get("pointCloudCutoff", 0.4), np.inf

    def outputs(self):
        cloud = ("cloud",) if self.points.get_num_connections() else ()
        return self.camera.image.outputs() + self.depth.outputs() + cloud

    def wanted(self) -> bool:
        return bool(self.camera.wanted() or self.depth_info.get_num_connections() or self.outputs())

    def measure(self, sensor) -> None:
        """Images and cloud come at the sensor's rate; ``<updateRate>`` holds back camera_info only, as upstream."""
        with_info = self.camera.gate.due(sensor.measurement_ns)
        header, outputs = self.camera.header(), self.outputs()

        def arrived(header: Header, frame: Frame) -> None:
            self.camera.image.publish(header, frame)
            self.depth.publish(header, frame)
            if "cloud" in frame.data:
                self.points.publish(self._cloud(header, frame.data["cloud"]))
            if with_info:
                self._publish_info(header)

        if outputs:
            self.camera.shoot(header, outputs, arrived)
        elif with_info:
            self._publish_info(header)

    def _publish_info(self, header: Header) -> None:
        self.camera.publish_info(header)
        if self.depth_info.get_num_connections():
            self.depth_info.publish(self.camera.info(header))

    def _cloud(self, header: Header, data) -> PointCloud2:
        width, height = self.camera.camera.width, self.camera.camera.height
        if not self.organised:
            width, height = width * height, 1
        return PointCloud2(header, height, width, _FIELDS, False, _POINT_STEP, _POINT_STEP * width, data, False)

    def reset(self) -> None:
        self.camera.gate.reset()

    def shutdown(self) -> None:
        self.camera.shutdown()
        self.depth.shutdown()
        self.depth_info.unregister()
        self.points.unregister()


class OpenniKinect(DepthCamera):
    """Depths outside ``<pointCloudCutoff>`` .. ``<pointCloudCutoffMax>`` (m) are invalid. The cloud has the image's
    rows and columns."""

    organised = True

    def depth_range(self, sdf):
        return sdf.get("pointCloudCutoff", 0.4), sdf.get("pointCloudCutoffMax", 5.0)
