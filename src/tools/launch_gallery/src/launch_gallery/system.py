"""What runs under this process's ROS master, and when it has come up."""

from __future__ import annotations

import re
import sys
import time
from collections.abc import Iterable

import rosgraph
import rospy
from rosgraph.names import anonymous_name

from . import session

_QUIET = 2.0  # s without a node or topic coming or going: the launch file has finished its work


def join(timeout: float) -> None:
    """Make this process a node of the master in its environment, as soon as there is one; exits if none comes."""
    end = time.monotonic() + timeout
    while not rosgraph.is_master_online():
        if time.monotonic() > end:
            sys.exit("no ROS master came up")
        time.sleep(0.1)
    rospy.init_node("launch_gallery", anonymous=True, disable_signals=True, disable_rostime=True, log_level=rospy.FATAL)


def lasting_name(node: str) -> str:
    """Name of a ``node`` without host and numbers, which ``$(anon name)`` makes anew whenever a launch file is read."""
    host = re.sub(r"_\d+_\d+$", "", anonymous_name(""))
    return re.sub(rf"{re.escape(host)}_\d+_\d+$", "", node)


class System:
    """``log``: file with roslaunch's output; ``nodes``, ``passing``: as :class:`.launches.Content` has them."""

    def __init__(self, log: str, nodes: Iterable[str], passing: Iterable[str]):
        self.log, self.nodes, self.passing = log, {lasting_name(node) for node in nodes}, {lasting_name(node) for node in passing}
        self.master = rosgraph.Master(rospy.get_name())

    def wait_until_settled(self, timeout: float) -> str:
        """Until all nodes of the launch file have come, those that pass have gone, and nothing comes or goes for a while.

        :returns: what is still amiss after ``timeout`` seconds of wall time; '' when nothing is.
        """
        start = changed = time.monotonic()
        before, missing, seen = None, set(), set()
        while time.monotonic() - start < timeout:
            now = self.master.getSystemState()
            here = {lasting_name(node) for registered in now for _, nodes in registered for node in nodes}
            ended = self.ended_nodes()
            seen |= here
            missing = self.nodes - seen - ended | self.passing - ended
            if now != before or missing:
                before, changed = now, time.monotonic()
            elif time.monotonic() - changed > _QUIET:
                return ""
            time.sleep(0.5)
        what = f"not all there: {', '.join(sorted(missing))}" if missing else "nodes or topics still come and go"
        return f"after {timeout:g} s {what}"

    def ended_nodes(self) -> set:
        """Nodes of which roslaunch has said that they finished or died."""
        return {lasting_name("/" + name) for name in re.findall(r"\[([\w/]+)-\d+\] process has", "\n".join(session.lines(self.log)))}

    def services(self) -> list[str]:
        return [name for name, _ in self.master.getSystemState()[2]]

    def published(self) -> list[tuple[str, str]]:
        """(topic, message type) of all that somebody else publishes."""
        return self._topics(0)

    def heard(self) -> list[tuple[str, str]]:
        """(topic, message type) of all that somebody else subscribes to."""
        return self._topics(1)

    def _topics(self, side: int) -> list[tuple[str, str]]:
        own = rospy.get_name()
        nodes = dict(self.master.getSystemState()[side])
        return [(topic, kind) for topic, kind in self.master.getTopicTypes() if set(nodes.get(topic, ())) - {own}]
