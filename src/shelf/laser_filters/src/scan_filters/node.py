"""Nodes that send scans through a chain of filters: ``scan_to_scan_filter_chain`` and its old kin ``generic_laser_filter_node``."""

from __future__ import annotations

import math
from collections.abc import Callable

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

PATIENCE = rospy.Duration(1.0)  # for a transform
QUEUE = 50  # scans


def rotation(q) -> np.ndarray:
    x, y, z, w = q.x, q.y, q.z, q.w
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def scan_of(message: LaserScan) -> Scan:
    """The arrays of a message."""
    return Scan(
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


class ChainOfFilters:
    """The filters that a parameter describes, with the transforms and the dynamic_reconfigure servers that they need.

    :param entries: the parameter's value. :param buffer: knows the transforms.
    :raises FilterError: the chain cannot be made.
    """

    def __init__(self, entries: object, buffer: tf2_ros.Buffer):
        self._buffer = buffer
        self._filters = chain(entries or [], self._transformed)
        self._servers = [self._serve(one) for one in self._filters if any(setting.live for setting in one.settings)]

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
            found = self._buffer.lookup_transform(to, whence, when, PATIENCE).transform
        except tf2_ros.TransformException as error:
            raise FilterError(f"no transform: {' '.join(str(error).split())}") from None
        place = found.translation
        return points @ rotation(found.rotation).T + (place.x, place.y, place.z)

    def apply(self, message: LaserScan) -> bool:
        """Send ``message`` through all filters, in place; False, told once a second, where one cannot."""
        scan = scan_of(message)
        stamp = scan.stamp
        if not run(self._filters, scan, lambda text: rospy.logerr_throttle(1, "scan not filtered: %s", text)):
            return False
        message.angle_min = scan.angle_min
        message.angle_max = scan.angle_min + max(len(scan.ranges) - 1, 0) * scan.angle_increment
        if scan.stamp != stamp:
            message.header.stamp += rospy.Duration.from_sec(scan.stamp - stamp)
        message.ranges, message.intensities = scan.ranges.tolist(), scan.intensities.tolist()
        return True


class Waiting:
    """Scans on a topic; where there is a frame, they wait until its transform is known.

    :param topic: of the scans. :param take: is called with each. :param frame: "" if none is waited for.
    :param tolerance: s, see TransformFilter.
    """

    def __init__(self, topic: str, take: Callable[[LaserScan], None], frame: str, tolerance: float):
        self._topic, self._take, self._filter = topic, take, None
        if frame:
            self._filter = TransformFilter(frame, QUEUE, take, tolerance)
            self.buffer: tf2_ros.Buffer = self._filter.buffer
        else:
            self.buffer = tf2_ros.Buffer()
            self._listener = tf2_ros.TransformListener(self.buffer)

    def start(self) -> None:
        """Listen."""
        take = self._filter.add if self._filter is not None else self._take
        self._scans = rospy.Subscriber(self._topic, LaserScan, take, queue_size=QUEUE)


def chain_parameter(name: str, *old: str) -> object:
    """What the parameter ``name`` describes, or one of its ``old`` names; None, and a warning, where there is none."""
    for other in old:
        if rospy.has_param(other):
            rospy.logwarn("parameter %s is the old name of %s", other, name)
            return rospy.get_param(other)
    entries = rospy.get_param(name, None)
    if entries is None:
        rospy.logwarn("no parameter %s: scans go through as they are", rospy.resolve_name(name))
    return entries


class Node:
    """:raises FilterError: the chain cannot be made."""

    def __init__(self):
        target, tolerance = rospy.get_param("~tf_message_filter_target_frame", ""), number("~tf_message_filter_tolerance", 0.03)
        self._scans = Waiting("scan", self._take, target, tolerance)
        self._filters = ChainOfFilters(chain_parameter("~scan_filter_chain", "~filter_chain"), self._scans.buffer)
        self._out = rospy.Publisher("scan_filtered", LaserScan, queue_size=QUEUE)
        self._scans.start()

    def _take(self, message: LaserScan) -> None:
        if self._filters.apply(message):
            self._out.publish(message)


class GenericNode:
    """``scan_in`` through the parameter ``/filter_chain`` to ``output``. :raises FilterError: the chain cannot be made."""

    def __init__(self):
        rospy.logwarn("generic_laser_filter_node is old; scan_to_scan_filter_chain does the same for any frame")
        self._scans = Waiting("scan_in", self._take, "base_link", 0.03)
        self._filters = ChainOfFilters(chain_parameter("/filter_chain"), self._scans.buffer)
        self._out = rospy.Publisher("output", LaserScan, queue_size=QUEUE)
        self._scans.start()

    def _take(self, message: LaserScan) -> None:
        if self._filters.apply(message):
            self._out.publish(message)


def run_node(name: str, kind: Callable[[], object]) -> int:
    """The node ``name``, all of which is an object of ``kind``; the exit code."""
    node_signals.init_node(name)
    try:
        node = kind()
    except (FilterError, ParameterError) as error:
        rospy.logerr("%s", error)
        return 1
    node_signals.spin()
    del node
    return 0


def main() -> int:
    return run_node("scan_to_scan_filter_chain", Node)


def generic() -> int:
    """generic_laser_filter_node."""
    return run_node("scan_filter_node", GenericNode)
