"""Commands to joints, and where they are: what all nodes of grippers share."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable

import node_signals
import rospy
from node_signals.parameters import ParameterError
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64

from .grippers import Gripper


class Joints:
    """The joints of ``gripper``: told on ``<joint>/command``, heard on ``joint_states``."""

    def __init__(self, gripper: Gripper) -> None:
        self._gripper = gripper
        self._publishers = {joint: rospy.Publisher(f"{joint}/command", Float64, queue_size=5) for joint in gripper.joints}
        self._positions: dict[str, float] = {}
        self._lock = threading.Lock()
        rospy.Subscriber("joint_states", JointState, self._hear)

    def _hear(self, message: JointState) -> None:
        with self._lock:
            self._positions.update((name, at) for name, at in zip(message.name, message.position) if name in self._publishers)

    def tell(self, opening: float) -> dict[str, float]:
        """
        :param opening: m
        :returns: the positions (rad) that the joints were told
        :raises OutOfReach: the gripper cannot be so wide
        """
        wanted = self._gripper.command(opening)
        for joint, position in wanted.items():
            self._publishers[joint].publish(position)
        return wanted

    def positions(self) -> dict[str, float] | None:
        """rad, of all joints; None as long as one was not heard of."""
        with self._lock:
            return dict(self._positions) if len(self._positions) == len(self._publishers) else None


def run(name: str, begin: Callable[[], object]) -> None:
    """A node: ``begin`` makes what it does, then it spins. One line where a parameter is wrong.

    :param name: of the node, unless its launch file says otherwise
    """
    node_signals.init_node(name)
    try:
        kept = begin()
    except ParameterError as error:
        rospy.logfatal("%s cannot start: %s.", rospy.get_name(), error)
        sys.exit(1)
    node_signals.spin()
    del kept
