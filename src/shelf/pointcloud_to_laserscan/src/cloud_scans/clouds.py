"""``laserscan_to_pointcloud_node``: clouds of the scans on ``scan_in``, while somebody listens to ``cloud``."""

from __future__ import annotations

import sys

import node_signals
import numpy as np
import rospy
import tf2_ros
from node_signals.parameters import get
from node_signals.transforms import TransformFilter
from sensor_msgs.msg import LaserScan, PointCloud2, PointField

from .node import moved, queue_size
from .projection import hits


class Node:
    """:raises ValueError: a parameter of another kind; one line."""

    def __init__(self):
        self._frame, self._size = get("~target_frame", "", str), queue_size()
        self._filter = TransformFilter(self._frame, self._size, self._take) if self._frame else None
        self._scan: rospy.Subscriber | None = None
        self._cloud = rospy.Publisher("cloud", PointCloud2, self, queue_size=10)

    def peer_subscribe(self, _topic, _publish, _peer) -> None:
        if self._scan is None:
            self._scan = rospy.Subscriber("scan_in", LaserScan, self._filter.add if self._filter else self._take, queue_size=self._size)

    def peer_unsubscribe(self, _topic, remaining: int) -> None:
        if not remaining and self._scan is not None:
            self._scan.unregister()
            self._scan = None

    def _take(self, scan: LaserScan) -> None:
        points, rays = hits(np.array(scan.ranges, np.float32), scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max)
        try:
            if self._filter is not None:
                points = moved(points, self._filter.buffer, self._frame, scan.header)
        except tf2_ros.TransformException as error:
            rospy.logerr_throttle(1, "scan from %s: %s", scan.header.frame_id, " ".join(str(error).split()))
            return
        columns = {"x": points[:, 0], "y": points[:, 1], "z": points[:, 2], "index": rays}
        if scan.intensities:
            lit = rays < len(scan.intensities)
            columns["intensity"] = np.zeros(len(rays), np.float32)
            columns["intensity"][lit] = np.array(scan.intensities, np.float32)[rays[lit]]
        self._cloud.publish(cloud(scan.header, columns, self._frame))


def cloud(header, columns: dict[str, np.ndarray], frame: str = "") -> PointCloud2:
    """A cloud of one row, in the order of laser_geometry: x, y, z, then intensity, then index.

    :param columns: the values of the points by the names of the fields. :param frame: in the place of the header's.
    """
    names = [name for name in ("x", "y", "z", "intensity", "index") if name in columns]
    kinds = {name: np.dtype("<i4" if name == "index" else "<f4") for name in names}
    table = np.empty(len(columns["x"]), [(name, kinds[name]) for name in names])
    for name in names:
        table[name] = columns[name]
    made = PointCloud2(height=1, width=len(table), point_step=table.itemsize, row_step=table.nbytes, is_dense=False, data=table.tobytes())
    made.header.seq, made.header.stamp, made.header.frame_id = header.seq, header.stamp, frame or header.frame_id
    made.fields = [PointField(name, 4 * i, PointField.INT32 if name == "index" else PointField.FLOAT32, 1) for i, name in enumerate(names)]
    return made


def main() -> int:
    node_signals.init_node("laserscan_to_pointcloud")
    try:
        node = Node()
    except ValueError as error:
        print(f"laserscan_to_pointcloud_node: {error}", file=sys.stderr)
        return 1
    node_signals.spin()
    del node
    return 0
