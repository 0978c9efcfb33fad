"""The programs ``load_map`` and ``save_map``: octomaps of a running move_group, from and to files."""

from __future__ import annotations

import argparse
import os

import node_signals
import rospy
from moveit_msgs.srv import LoadMap, SaveMap

_PATIENCE = 5.0  # s that move_group is waited for


def load() -> int:
    """Let move_group take its octomap from a file; the exit code."""
    return _ask("load_map", LoadMap, "take an octomap from a file")


def save() -> int:
    """Let move_group write its octomap to a file; the exit code."""
    return _ask("save_map", SaveMap, "write the octomap to a file")


def _ask(name: str, kind, what: str) -> int:
    parser = argparse.ArgumentParser(prog=name, description=f"Let move_group {what}.")
    parser.add_argument("file", metavar="FILE", help="an octomap, .bt or .ot")
    file = os.path.abspath(parser.parse_args(rospy.myargv()[1:]).file)  # move_group has a working folder of its own
    node_signals.init_node(name, anonymous=True)
    service = rospy.resolve_name(f"move_group/{name}")
    try:
        rospy.wait_for_service(service, _PATIENCE)
        if rospy.ServiceProxy(service, kind)(file).success:
            return 0
        rospy.logfatal("move_group could not %s: its log says why (%s)", what, file)
    except (rospy.ROSException, rospy.ServiceException) as error:
        rospy.logfatal("the service %s does not answer: have you launched move_group? (%s)", service, " ".join(str(error).split()))
    return 1
