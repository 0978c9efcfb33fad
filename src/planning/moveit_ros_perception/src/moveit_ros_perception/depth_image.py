"""``occupancy_map_monitor/DepthImageOctomapUpdater``: an octomap from a depth camera's images."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import rospy
from moveit_ros_occupancy_map_monitor.updater import MOST_POINTS, OccupancyMapUpdater, UpdaterError
from sensor_msgs.msg import CameraInfo, Image

_ENCODINGS = {"32FC1": ("f4", 1.0), "16UC1": ("u2", 1e-3), "mono16": ("u2", 1e-3)}
_NOISE = 0.125 / (525.0 * 0.075)  # per m: steps of depth of a usual structured light camera grow with the square of the distance


def depths(message: Image) -> np.ndarray:
    """(height, width) depths of ``message`` in m along the camera's axis; NaN where there is none.

    :raises UpdaterError: encoding or size of the data.
    """
    if message.encoding not in _ENCODINGS:
        raise UpdaterError(f"Unexpected encoding type: '{message.encoding[:20]}' (known are {', '.join(_ENCODINGS)})")
    code, scale = _ENCODINGS[message.encoding]
    kind = np.dtype((">" if message.is_bigendian else "<") + code)
    if message.step < message.width * kind.itemsize or len(message.data) < message.step * message.height:
        raise UpdaterError(f"an image of {message.width} x {message.height} pixels with {len(message.data)} bytes is not whole")
    rows = np.frombuffer(message.data, np.uint8, message.step * message.height).reshape(message.height, message.step)
    values = np.ascontiguousarray(rows[:, : message.width * kind.itemsize]).view(kind).astype(float) * scale
    values[~(values > 0) | ~np.isfinite(values)] = np.nan
    return values


def rays(values: np.ndarray, info: CameraInfo, skip: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Directions (n, 3) with z = 1 in the optical frame, and depths (n,), of pixels inside a margin of ``skip`` (vertical,
    horizontal) that have a depth; of very many only some.

    :param values: (height, width) depths, m; NaN is none. :param info: of the camera that they are of.
    :raises UpdaterError: the camera's parameters cannot be used.
    """
    fx, cx, fy, cy = info.K[0], info.K[2], info.K[4], info.K[5]
    if not (all(map(math.isfinite, (fx, cx, fy, cy))) and fx > 0 and fy > 0):
        raise UpdaterError(f"the camera_info has no usable K (fx {fx:g}, fy {fy:g})")
    height, width = values.shape
    step = max(1, math.ceil(math.sqrt(values.size / MOST_POINTS)))
    v = np.arange(skip[0], max(skip[0], height - skip[0]), step)
    u = np.arange(skip[1], max(skip[1], width - skip[1]), step)
    chosen = values[np.ix_(v, u)]
    good = np.isfinite(chosen)
    x, y = np.meshgrid((u - cx) / fx, (v - cy) / fy)
    return np.stack([x[good], y[good], np.ones(good.sum())], axis=1), chosen[good]


class DepthImageUpdater(OccupancyMapUpdater):
    """``image_topic``, with the camera_info beside it; depths from ``near_clipping_plane_distance`` to
    ``far_clipping_plane_distance`` m count. What is known is grown by ``padding_offset`` m and by ``padding_scale`` times the
    camera's noise. Publishes ``~filtered_depth`` (``filtered_cloud_topic``): mm, 0 where the robot
    or known objects are."""

    def __init__(self, monitor, settings):
        self._topic = rospy.resolve_name(str(settings.get("image_topic", "depth")))
        super().__init__(monitor, settings)
        self.near = self.number("near_clipping_plane_distance", 0.3)
        self.far = self.number("far_clipping_plane_distance", 5.0)
        self.shadow = self.number("shadow_threshold", 0.04)
        self.scale = self.number("padding_scale", 0.0)
        self.padding = self.number("padding_offset", 0.02)
        self.skip = (int(self.number("skip_vertical_pixels", 4)), int(self.number("skip_horizontal_pixels", 6)))
        if not 0 <= self.near < self.far or min(self.skip) < 0:
            raise UpdaterError(f"clipping planes at {self.near:g} and {self.far:g} m, and {self.skip} skipped pixels make no sense")
        space = self.text("ns") + "/" if self.text("ns") else ""
        self._filtered = rospy.Publisher("~" + space + (self.text("filtered_cloud_topic") or "filtered_depth"), Image, queue_size=1)
        self._info: CameraInfo | None = None
        self._info_topic = self._topic.rsplit("/", 1)[0] + "/camera_info"
        self._subscribers = [
            rospy.Subscriber(self._info_topic, CameraInfo, self._on_info, queue_size=1),
            rospy.Subscriber(self._topic, Image, self.put, queue_size=1, buff_size=1 << 24),
        ]
        rospy.loginfo("Listening to '%s' for the octomap", self._topic)

    @property
    def topic(self) -> str:
        return self._topic

    def stop(self) -> None:
        for subscriber in self._subscribers:
            subscriber.unregister()
        super().stop()

    def _grown(self, distance: float) -> float:
        """m that known things are grown by at a distance."""
        return self.padding + self.scale * _NOISE * distance**2

    def _on_info(self, message: CameraInfo) -> None:
        self._info = message

    def work(self, message: Image) -> None:
        if self._info is None:
            raise UpdaterError(f"no camera_info came on {self._info_topic} yet: without it depths have no directions")
        values = depths(message)
        directions, depth = rays(values, self._info, self.skip)
        hit = (depth >= self.near) & (depth <= self.far)
        ends, beyond = directions[hit] * depth[hit, None], directions[depth > self.far] * self.far
        labels = self.monitor.see(message.header.frame_id, message.header.stamp, ends, beyond, 1.0, self._grown, self.shadow)
        if self._filtered.get_num_connections():
            self._publish(message, self._info.K, ends[labels == 0], values.shape)

    def _publish(self, message: Image, k: Sequence[float], ends: np.ndarray, shape: tuple[int, ...]) -> None:
        image = np.zeros(shape, "<u2")
        u = np.rint(ends[:, 0] / ends[:, 2] * k[0] + k[2]).astype(int)
        v = np.rint(ends[:, 1] / ends[:, 2] * k[4] + k[5]).astype(int)
        image[np.clip(v, 0, shape[0] - 1), np.clip(u, 0, shape[1] - 1)] = np.clip(ends[:, 2] * 1e3 + 0.5, 0, 65535)
        self._filtered.publish(
            Image(header=message.header, height=shape[0], width=shape[1], encoding="16UC1", step=2 * shape[1], data=image.tobytes())
        )
