"""The node ``moveit_joy``: a joystick moves the goal marker and has motions planned and executed.

Left stick: the goal to the side, and forward or back. Right stick: turned about the vertical, and up or down. Buttons as an
Xbox pad names them: X plans, B executes, A stops, Y sets the goal to where the robot is.
"""
from __future__ import annotations

from typing import Optional

import numpy as np
import rospy
from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import Joy
from std_msgs.msg import Empty
from tf.transformations import quaternion_about_axis, quaternion_multiply

import node_signals

_SPEED, _TURN = 0.2, 0.8  # m/s and rad/s of a stick pushed all the way
_STILL = 0.15  # of a stick's way that counts as none
_BUTTONS = {2: "plan", 1: "execute", 0: "stop", 3: "update_goal_state"}


def main() -> int:
    """Run the node; the exit code. ``~link`` is the link whose goal is moved."""
    node_signals.init_node("moveit_joy")
    link = str(rospy.get_param("~link", "")).strip("/")
    if not link:
        rospy.logerr("parameter %s is missing: it names the link at the end of the group", rospy.resolve_name("~link"))
        return 1
    Joystick(link)
    node_signals.spin()
    return 0


class Joystick:
    """Turns Joy messages into poses of the goal and commands."""

    def __init__(self, link: str):
        self._pose: Optional[PoseStamped] = None
        self._before: tuple = ()
        self._time: Optional[rospy.Time] = None
        self._commands = {name: rospy.Publisher("/rviz/moveit/" + name, Empty, queue_size=5) for name in _BUTTONS.values()}
        self._goal = rospy.Publisher(f"/rviz/moveit/move_marker/goal_{link}", PoseStamped, queue_size=1)
        self._subscribers = [rospy.Subscriber("goal_marker/pose", PoseStamped, self._on_pose, queue_size=1),
                             rospy.Subscriber("joy", Joy, self._on_joy, queue_size=1)]

    def _on_pose(self, message: PoseStamped) -> None:
        self._pose = message

    def _on_joy(self, message: Joy) -> None:
        for number, name in _BUTTONS.items():
            pressed = number < len(message.buttons) and message.buttons[number]
            if pressed and not (number < len(self._before) and self._before[number]):
                self._commands[name].publish()
        self._before = message.buttons
        now = rospy.Time.now()
        passed = min(max((now - self._time).to_sec(), 0.0), 0.1) if self._time is not None else 0.05
        self._time = now
        sticks = np.array([message.axes[i] if i < len(message.axes) else 0.0 for i in (1, 0, 4, 3)])
        sticks[np.abs(sticks) < _STILL] = 0.0
        if self._pose is None or not np.isfinite(sticks).all() or not sticks.any():
            return
        self._move(*(sticks * passed))

    def _move(self, forward: float, left: float, up: float, turn: float) -> None:
        pose = PoseStamped(header=self._pose.header)
        was, pose.pose.position.z = self._pose.pose, self._pose.pose.position.z + _SPEED * up
        pose.pose.position.x, pose.pose.position.y = was.position.x + _SPEED * forward, was.position.y + _SPEED * left
        turned = quaternion_multiply(quaternion_about_axis(_TURN * turn, (0, 0, 1)),
                                     (was.orientation.x, was.orientation.y, was.orientation.z, was.orientation.w))
        new = pose.pose.orientation
        new.x, new.y, new.z, new.w = turned
        self._pose = pose
        self._goal.publish(pose)
