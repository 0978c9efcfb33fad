"""``pointcloud_to_laserscan_node``: scans of the clouds on ``cloud_in``, while somebody listens to ``scan``."""

from __future__ import annotations

import math
import os
import sys

import node_signals
import numpy as np
import rospy
import tf2_ros
from node_signals.parameters import get, number
from node_signals.transforms import TransformFilter
from sensor_msgs.msg import LaserScan, PointCloud2, PointField
from std_msgs.msg import Header

from .projection import Fan, turned, xyz

_DEFAULTS = {
    "min_height": -sys.float_info.max,
    "max_height": sys.float_info.max,
    "angle_min": -math.pi,
    "angle_max": math.pi,
    "angle_increment": math.pi / 180,
    "range_min": 0.0,
    "range_max": sys.float_info.max,
}


class Node:
    """:raises ValueError: a parameter that makes no fan; one line."""

    def __init__(self):
        self._fan = Fan(**{name: get(f"~{name}", value, float) for name, value in _DEFAULTS.items()})
        self._frame = rospy.get_param("~target_frame", "")
        self._size = queue_size()
        self._scan_time = number("~scan_time", 1 / 30)
        beyond = self._fan.range_max + get("~inf_epsilon", 1.0, float)
        self._empty = math.inf if rospy.get_param("~use_inf", True) else beyond
        self._filter = TransformFilter(self._frame, self._size, self._take) if self._frame else None
        self._cloud: rospy.Subscriber | None = None
        self._scan = rospy.Publisher("scan", LaserScan, self, queue_size=10)

    # who listens to the scan; clouds are large, and are only fetched for somebody
    def peer_subscribe(self, _topic, _publish, _peer) -> None:
        if self._cloud is None:
            take = self._filter.add if self._filter else self._take
            self._cloud = rospy.Subscriber("cloud_in", PointCloud2, take, queue_size=self._size, buff_size=1 << 24)

    def peer_unsubscribe(self, _topic, remaining: int) -> None:
        if not remaining and self._cloud is not None:
            self._cloud.unregister()
            self._cloud = None

    def _take(self, cloud: PointCloud2) -> None:
        try:
            points = self._points(cloud)
        except (ValueError, tf2_ros.TransformException) as error:
            rospy.logwarn_throttle(5, "cloud from %s: %s", cloud.header.frame_id, " ".join(str(error).split()))
            return
        fan = self._fan
        scan = LaserScan(
            header=cloud.header,
            angle_min=fan.angle_min,
            angle_max=fan.angle_max,
            time_increment=0.0,
            angle_increment=fan.angle_increment,
            scan_time=self._scan_time,
            range_min=fan.range_min,
            range_max=min(fan.range_max, 3.4028234663852886e38),
        )
        scan.header.frame_id = self._frame or cloud.header.frame_id
        scan.ranges = fan.ranges(points, self._empty)
        self._scan.publish(scan)

    def _points(self, cloud: PointCloud2):
        fields = {field.name: field for field in cloud.fields if field.datatype == PointField.FLOAT32}
        if not all(name in fields for name in "xyz"):
            raise ValueError("it has no fields x, y, z of type FLOAT32")
        offsets = [fields[name].offset for name in "xyz"]
        points = xyz(cloud.data, cloud.width, cloud.height, cloud.point_step, cloud.row_step, offsets, cloud.is_bigendian)
        return points if self._filter is None else moved(points, self._filter.buffer, self._frame, cloud.header)


def queue_size() -> int:
    """How many messages may wait, as ``~concurrency_level`` says it: that many; 0: one for each processor."""
    level = round(number("~concurrency_level", 1))
    return level if level > 0 else os.cpu_count() or 1


def moved(points: np.ndarray, buffer: tf2_ros.Buffer, frame: str, header: Header) -> np.ndarray:
    """(N, 3) ``points`` of a message with ``header`` as ``frame`` has them.

    :param buffer: knows the transform, or raises.
    """
    if frame == header.frame_id:
        return points
    found = buffer.lookup_transform(frame, header.frame_id, header.stamp).transform
    place, turn = found.translation, found.rotation
    return turned(points, (place.x, place.y, place.z), (turn.x, turn.y, turn.z, turn.w))


def main() -> int:
    node_signals.init_node("pointcloud_to_laserscan")
    try:
        node = Node()
    except (ValueError, TypeError) as error:
        rospy.logerr("%s", error)
        return 1
    node_signals.spin()
    del node
    return 0
