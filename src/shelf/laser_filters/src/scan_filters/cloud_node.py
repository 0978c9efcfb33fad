"""``scan_to_cloud_filter_chain``: scans on ``scan`` through ``~scan_filter_chain`` to clouds in ``~target_frame`` on ``cloud_filtered``."""

from __future__ import annotations

import math

import numpy as np
import rospy
import tf2_ros
from node_signals.parameters import get, number
from sensor_msgs.msg import LaserScan, PointCloud2, PointField

from .base import FilterError
from .clouds import FIELDS, Pose, columns
from .node import PATIENCE, ChainOfFilters, Waiting, chain_parameter, run_node, scan_of

_ON = {"viewpoint": False}  # of the columns; the others are there unless told


class CloudNode:
    """:raises FilterError: a chain cannot be made."""

    def __init__(self):
        for name in ("~cloud_filter_chain", "~cloud_filters/filter_chain", "~cloud_filters/cloud_filter_chain"):
            if rospy.get_param(name, None):
                raise FilterError(
                    f"parameter {rospy.resolve_name(name)}: there are no filters of clouds here; filter the scan, or the cloud"
                )
        self._frame = get("~target_frame", "base_link", str)
        self._farthest = get("~laser_max_range", math.inf, float)
        self._corrects = get("~incident_angle_correction", True, bool)
        self._wanted = {what for what in FIELDS if get(f"~cloud_channel_{what}", _ON.get(what, True), bool)}
        self._scans = Waiting(get("~scan_topic", "scan", str), self._take, self._frame, number("~notifier_tolerance", 0.03))
        old = ("~scan_filters/filter_chain", "~scan_filters/scan_filter_chain")
        self._filters = ChainOfFilters(chain_parameter("~scan_filter_chain", *old), self._scans.buffer)
        self._out = rospy.Publisher(get("~cloud_topic", "cloud_filtered", str), PointCloud2, queue_size=10)
        self._scans.start()

    def _take(self, message: LaserScan) -> None:
        if not self._filters.apply(message):
            return
        scan = scan_of(message)
        if self._corrects:  # 3 cm for rays that meet a wall beside the sensor's axis, as they are seen too near
            scan.ranges = (scan.ranges + 0.03 * np.exp(-np.abs(np.sin(scan.angles)))).astype(np.float32)
        last = rospy.Duration.from_sec(max(len(scan.ranges) - 1, 0) * scan.time_increment)
        try:
            start, end = (self._pose(scan.frame, when) for when in (message.header.stamp, message.header.stamp + last))
        except tf2_ros.TransformException as error:
            rospy.logwarn_throttle(1, "scan from %s dropped: %s", scan.frame, " ".join(str(error).split()))
            return
        table = columns(scan, start, end, self._farthest, self._wanted)
        cloud = PointCloud2(height=1, width=len(table), point_step=table.itemsize, row_step=table.nbytes, data=table.tobytes())
        cloud.header.stamp, cloud.header.frame_id = message.header.stamp, self._frame
        cloud.fields = [
            PointField(name, 4 * i, PointField.INT32 if name == "index" else PointField.FLOAT32, 1)
            for i, name in enumerate(table.dtype.names)
        ]
        self._out.publish(cloud)

    def _pose(self, frame: str, when: rospy.Time) -> Pose:
        found = self._scans.buffer.lookup_transform(self._frame, frame, when, PATIENCE).transform
        place, turn = found.translation, found.rotation
        return Pose(np.array((place.x, place.y, place.z)), np.array((turn.x, turn.y, turn.z, turn.w)))


def main() -> int:
    return run_node("scan_to_cloud_filter_chain", CloudNode)
