"""``scan_to_scan_filter_chain``: scans on ``scan`` through ``~scan_filter_chain`` to ``scan_filtered``."""

from __future__ import annotations

import math

import node_signals
import numpy as np
import rospy
import tf2_ros
from dynamic_parameters import Parameter, Server
from node_signals.parameters import ParameterError, number
from node_signals.transforms import TransformFilter
from sensor_msgs.msg import LaserScan

from .base import Filter, FilterError, Scan
from .chain import chain, run

_PATIENCE = rospy.Duration(1.0)  # for a transform
_QUEUE = 50  # scans


def _rotation(q) -> np.ndarray:
    x, y, z, w = q.x, q.y, q.z, q.w
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


class Node:
    """:raises FilterError: the chain cannot be made."""

    def __init__(self):
        target = rospy.get_param("~tf_message_filter_target_frame", "")
        if target:  # scans wait for their transform
            self._filter: TransformFilter | None = TransformFilter(target, _QUEUE, self._take, number("~tf_message_filter_tolerance", 0.03))
            self._buffer = self._filter.buffer
        else:
            self._filter = None
            self._buffer = tf2_ros.Buffer()
            self._listener = tf2_ros.TransformListener(self._buffer)
        name = "~filter_chain" if rospy.has_param("~filter_chain") else "~scan_filter_chain"
        if name == "~filter_chain":
            rospy.logwarn("parameter ~filter_chain is the old name of ~scan_filter_chain")
        entries = rospy.get_param(name, None)
        if entries is None:
            rospy.logwarn("no parameter %s: scans go through as they are", rospy.resolve_name("~scan_filter_chain"))
        self._filters = chain(entries or [], self._transformed)
        self._servers = [self._serve(one) for one in self._filters if any(setting.live for setting in one.settings)]
        self._out = rospy.Publisher("scan_filtered", LaserScan, queue_size=_QUEUE)
        self._scans = rospy.Subscriber("scan", LaserScan, self._filter.add if self._filter else self._take, queue_size=_QUEUE)

    def _serve(self, one: Filter) -> Server:
        live = [setting for setting in one.settings if setting.live and setting.kind is not object]
        table = [
            Parameter(s.name, s.kind, one.values[s.name] if s.default is None else s.default, *(() if s.low is None else (s.low, s.high)))
            for s in live
        ]
        return Server(
            f"{rospy.get_name()}/{one.name}",
            table,
            lambda config, _level: one.change(config),
            initial={s.name: one.values[s.name] for s in live if s.name in one.given or not one.remembers},
        )

    def _transformed(self, points: np.ndarray, to: str, whence: str, stamp: float) -> np.ndarray:
        when = rospy.Time() if math.isnan(stamp) else rospy.Time.from_sec(stamp)
        try:
            found = self._buffer.lookup_transform(to, whence, when, _PATIENCE).transform
        except tf2_ros.TransformException as error:
            raise FilterError(f"no transform: {' '.join(str(error).split())}") from None
        place = found.translation
        return points @ _rotation(found.rotation).T + (place.x, place.y, place.z)

    def _take(self, message: LaserScan) -> None:
        scan = Scan(
            np.array(message.ranges, np.float32),
            np.array(message.intensities, np.float32),
            message.angle_min,
            message.angle_increment,
            message.range_min,
            message.range_max,
            message.header.frame_id,
            message.header.stamp.to_sec(),
            message.time_increment,
        )
        stamp = scan.stamp
        if not run(self._filters, scan, lambda text: rospy.logerr_throttle(1, "scan not filtered: %s", text)):
            return
        message.angle_min = scan.angle_min
        message.angle_max = scan.angle_min + max(len(scan.ranges) - 1, 0) * scan.angle_increment
        if scan.stamp != stamp:
            message.header.stamp += rospy.Duration.from_sec(scan.stamp - stamp)
        message.ranges, message.intensities = scan.ranges.tolist(), scan.intensities.tolist()
        self._out.publish(message)


def main() -> int:
    node_signals.init_node("scan_to_scan_filter_chain")
    try:
        node = Node()
    except (FilterError, ParameterError) as error:
        rospy.logerr("%s", error)
        return 1
    node_signals.spin()
    del node
    return 0
