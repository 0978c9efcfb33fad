"""What of MoveIt is there. No Qt in here."""

from __future__ import annotations

import socket
from typing import Any, NamedTuple
from xmlrpc.client import Error as XmlRpcError
from xmlrpc.client import ServerProxy

import rosgraph
from node_signals.bounded_calls import Transport

NODES = ("/move_group",)
PARAMETERS = ("/robot_description", "/robot_description_semantic")
#: What MoveIt can see the world with.
SENSOR_TYPES = ("sensor_msgs/PointCloud", "sensor_msgs/PointCloud2", "sensor_msgs/Image", "sensor_msgs/CameraInfo")

_TIMEOUT = 1.0  # s: a node that is stopped must not hold up the others
_CALLER = "/rqt_moveit"


class Presence(NamedTuple):
    """One look. A reason is empty for what is there, else a sentence for a student."""

    nodes: dict[str, str]
    parameters: dict[str, str]


def _why_no_node(master: rosgraph.Master, name: str) -> str:
    try:
        node: Any = ServerProxy(master.lookupNode(name), transport=Transport(_TIMEOUT))
    except rosgraph.MasterError:
        return f"{name} is not registered at the master: start the launch file of a MoveIt configuration, such as its demo.launch"
    try:
        node.getPid(_CALLER)
    except (OSError, XmlRpcError) as error:
        waited = isinstance(error, socket.timeout)
        return f"{name} is registered at the master, but {'hangs' if waited else 'has died'}: end it, then rosnode cleanup"
    return ""


def _why_no_parameter(master: rosgraph.Master, name: str) -> str:
    if master.hasParam(name):
        return ""
    return f"{name} is not on the parameter server: planning_context.launch of a MoveIt configuration sets it"


def look() -> Presence:
    """Ask the master and the nodes: not for the GUI's thread.

    :raises rosgraph.MasterException or OSError: no master.
    """
    master = rosgraph.Master(_CALLER)
    return Presence({name: _why_no_node(master, name) for name in NODES}, {name: _why_no_parameter(master, name) for name in PARAMETERS})
