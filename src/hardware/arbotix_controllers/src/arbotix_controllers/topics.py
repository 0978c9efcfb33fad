"""The older nodes: openings (m) on ~command, without an answer."""

from __future__ import annotations

import math

import rospy
import tf2_ros
from geometry_msgs.msg import TransformStamped
from node_signals.parameters import number
from std_msgs.msg import Float64

from .commands import Joints, run
from .grippers import Gripper, OutOfReach, Table
from .parameters import finger_length, one_jaw, swinging, two_jaws

_FRAMES = rospy.Duration(1 / 15)  # between two transforms of the fingers


class Commanded:
    """~command moves ``gripper``; one that it cannot do is a line."""

    def __init__(self, gripper: Gripper) -> None:
        self.joints = Joints(gripper)
        rospy.Subscriber("~command", Float64, self._command)

    def _command(self, message: Float64) -> None:
        try:
            self.joints.tell(message.data)
        except OutOfReach as error:
            rospy.logerr("%s: %s", rospy.get_name(), error)


class Shown(Commanded):
    """Its fingers are frames: gripper_left_link and gripper_right_link, to both sides of gripper_link."""

    def __init__(self, gripper: Gripper) -> None:
        super().__init__(gripper)
        self._gripper = gripper
        self._broadcaster = tf2_ros.TransformBroadcaster()
        self._timer = rospy.Timer(_FRAMES, self._show, reset=True)

    def _show(self, _event) -> None:
        at = self.joints.positions()
        opening = self._gripper.opening(at) if at else 0.0
        transforms = []
        for name, side in (("left", -0.5), ("right", 0.5)):
            transform = TransformStamped(child_frame_id=f"gripper_{name}_link")
            transform.header.frame_id, transform.header.stamp = "gripper_link", rospy.Time.now()
            transform.transform.translation.y, transform.transform.rotation.w = side * opening, 1.0
            transforms.append(transform)
        self._broadcaster.sendTransform(transforms)


def one_side() -> None:
    run("one_side_gripper_controller", lambda: Commanded(swinging(one_jaw("gripper_joint"), -math.inf, math.inf)))


def two_sides() -> None:
    def begin() -> Commanded:
        low, high = number("~min", 0.0), number("~max", 2 * finger_length())
        return Commanded(swinging(two_jaws("l_gripper_joint", "r_gripper_joint"), low, high))

    run("parallel_gripper_controller", begin)


def linkage() -> None:
    run("gripper_controller", lambda: Shown(Table("gripper_joint", number("~min", 0.0), number("~max", 0.042))))
