"""``occupancy_map_monitor/PointCloudOctomapUpdater``: an octomap from point clouds."""

from __future__ import annotations

import math

import numpy as np
import rospy
from moveit_ros_occupancy_map_monitor.updater import MOST_POINTS, OccupancyMapUpdater, UpdaterError
from sensor_msgs.msg import PointCloud2, PointField

_KINDS = {PointField.FLOAT32: "f4", PointField.FLOAT64: "f8"}


def points(message: PointCloud2, subsample: int = 1) -> np.ndarray:
    """(n, 3) finite points of every ``subsample``-th row and column of ``message``, in its frame, m; of very many only some.

    :raises UpdaterError: fields or size of the data.
    """
    fields = {field.name: field for field in message.fields}
    if any(name not in fields or fields[name].datatype not in _KINDS for name in "xyz"):
        raise UpdaterError(f"a point cloud needs the fields x, y and z of type float; this one has {', '.join(fields) or 'none'}")
    if (
        message.point_step < 1
        or message.row_step < message.width * message.point_step
        or len(message.data) < message.height * message.row_step
    ):
        raise UpdaterError(f"a cloud of {message.width} x {message.height} points with {len(message.data)} bytes is not whole")
    order = ">" if message.is_bigendian else "<"
    formats = [order + _KINDS[fields[name].datatype] for name in "xyz"]
    if any(fields[name].offset + np.dtype(kind).itemsize > message.point_step for name, kind in zip("xyz", formats)):
        raise UpdaterError(f"a point of {message.point_step} bytes does not hold its fields x, y and z")
    kind = np.dtype(
        {"names": list("xyz"), "formats": formats, "offsets": [fields[name].offset for name in "xyz"], "itemsize": message.point_step}
    )
    rows = np.frombuffer(message.data, np.uint8, message.height * message.row_step).reshape(message.height, message.row_step)
    table = np.ascontiguousarray(rows[::subsample, : message.width * message.point_step]).view(kind)[:, ::subsample].reshape(-1)
    found = np.stack([table[name].astype(float) for name in "xyz"], axis=1)
    found = found[np.isfinite(found).all(axis=1)]
    return found[:: max(1, math.ceil(len(found) / MOST_POINTS))]


class PointCloudUpdater(OccupancyMapUpdater):
    """``point_cloud_topic``; points further than ``max_range`` m only tell what is free. Publishes the points that went into
    the map on ``filtered_cloud_topic``."""

    def __init__(self, monitor, settings):
        if not settings.get("point_cloud_topic"):
            raise UpdaterError("point_cloud_topic is missing")
        self._topic = rospy.resolve_name(str(settings["point_cloud_topic"]))
        super().__init__(monitor, settings)
        self.range = self.number("max_range", monitor.max_range)
        self.scale, self.padding = self.number("padding_scale", 1.0), self.number("padding_offset", 0.0)
        self.subsample = max(1, int(self.number("point_subsample", 1)))
        space = self.text("ns") + "/" if self.text("ns") else ""
        name = self.text("filtered_cloud_topic")
        self._filtered = rospy.Publisher("~" + space + name, PointCloud2, queue_size=1) if name else None
        self._subscriber = rospy.Subscriber(self._topic, PointCloud2, self.put, queue_size=1, buff_size=1 << 24)
        rospy.loginfo("Listening to '%s' for the octomap", self._topic)

    @property
    def topic(self) -> str:
        return self._topic

    def stop(self) -> None:
        self._subscriber.unregister()
        super().stop()

    def work(self, message: PointCloud2) -> None:
        found = points(message, self.subsample)
        distance = np.linalg.norm(found, axis=1)
        near = distance <= self.range
        ends, beyond = found[near], found[~near] * (self.range / distance[~near, None])
        labels = self.monitor.see(message.header.frame_id, message.header.stamp, ends, beyond, self.scale, lambda _distance: self.padding)
        if self._filtered is not None and self._filtered.get_num_connections():
            self._publish(self._filtered, message, ends[labels == 0])

    @staticmethod
    def _publish(publisher: rospy.Publisher, message: PointCloud2, kept: np.ndarray) -> None:
        fields = [PointField(name, 4 * i, PointField.FLOAT32, 1) for i, name in enumerate("xyz")]
        publisher.publish(
            PointCloud2(
                header=message.header,
                height=1,
                width=len(kept),
                fields=fields,
                point_step=12,
                row_step=12 * len(kept),
                data=kept.astype("<f4").tobytes(),
                is_dense=True,
            )
        )
