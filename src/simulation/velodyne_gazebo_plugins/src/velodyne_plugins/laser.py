"""libgazebo_ros_velodyne_laser.so and its _gpu_ sister: a fan of rays as sensor_msgs/PointCloud2.

The points lie as velodyne_pointcloud puts them: x, y, z, intensity, ring (0 is the lowest laser), time. All rays are cast at
the same instant, so time is 0.
"""

import numpy as np
from gazebo_plugins.cameras.image_message import PointCloud2
from gazebo_plugins.ros_side import Topics, subscribed
from gazebo_plugins.sensors.laser import RayFan
from gazebo_ros.plugin import SensorPlugin
from sensor_msgs.msg import PointField

_POINT = np.dtype([("xyz", "<f4", 3), ("intensity", "<f4"), ("ring", "<u2"), ("time", "<f4")])
_FIELDS = [
    PointField(name, offset, kind, 1)
    for name, offset, kind in (
        ("x", 0, PointField.FLOAT32),
        ("y", 4, PointField.FLOAT32),
        ("z", 8, PointField.FLOAT32),
        ("intensity", 12, PointField.FLOAT32),
        ("ring", 16, PointField.UINT16),
        ("time", 18, PointField.FLOAT32),
    )
]


class VelodyneLaser(SensorPlugin):
    """``<min_range>``, ``<max_range>`` (m) and ``<min_intensity>`` leave points out, ``<gaussianNoise>`` (m) blurs their range;
    ``<organize_cloud>`` keeps all, with NaN for those left out, one row for each laser."""

    def load(self, server, sensor, sdf) -> None:
        self.fan = fan = RayFan(server, sensor)
        self.topics = Topics(sdf, sensor.model.name, "C")
        self.frame = self.topics.frame(sdf.text_or("frameName", "/world"))
        self.least, self.most = max(sdf.get("min_range", 0.0), fan.min), min(sdf.get("max_range", np.inf), fan.max)
        self.least_intensity = sdf.get("min_intensity", -np.inf)
        self.organized = sdf.get("organize_cloud", False)
        self.sigma = sdf.get("gaussianNoise", 0.0)
        self.rng = server.world.rng(sensor.scoped_name + "/velodyne_laser")
        self.shape = fan.vertical.count, fan.horizontal.count
        self.directions_S = fan.reported_directions()
        self.rings = np.repeat(np.arange(self.shape[0], dtype=np.uint16), self.shape[1])
        self.publisher = self.topics.publisher(sdf.text_or("topicName", "/points"), PointCloud2)
        sensor.connect(self.measure, subscribed(self.publisher))

    def measure(self, sensor) -> None:
        ranges, intensities = self.fan.cast()
        kept = (ranges > self.least) & (ranges < self.most) & (intensities >= self.least_intensity)
        if self.sigma:
            ranges = ranges + self.sigma * self.rng.standard_normal(len(ranges))
            kept &= (ranges > self.least) & (ranges < self.most)
        points = np.zeros(len(ranges), _POINT)
        points["xyz"] = self.directions_S * np.where(kept, ranges, np.nan)[:, None]
        points["intensity"], points["ring"] = intensities, self.rings
        if self.organized:
            height, width = self.shape
        else:
            # Column after column, as the device turns.
            points = points.reshape(self.shape).T[kept.reshape(self.shape).T]
            height, width = 1, len(points)
        message = PointCloud2(
            height=height,
            width=width,
            fields=_FIELDS,
            point_step=_POINT.itemsize,
            row_step=width * _POINT.itemsize,
            data=points.tobytes(),
            is_dense=not self.organized,
        )
        message.header.stamp, message.header.frame_id = sensor.measurement_time, self.frame
        self.publisher.publish(message)

    def shutdown(self) -> None:
        self.topics.close()
        self.fan.close()
