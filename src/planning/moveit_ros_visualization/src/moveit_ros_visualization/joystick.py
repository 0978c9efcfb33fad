"""The node ``moveit_joy``: a gamepad moves the goal in RViz's MotionPlanning panel and has motions planned and executed.

The panel listens once its box *External Comm.* is checked. Controls, by their names on a PlayStation's and on an Xbox pad:

left stick           the goal forward and to the side, in the hand's own axes
L2, R2 (LT, RT)      along the hand's z axis, there and back; L1, R1 (LB, RB) turn about it, the cross about the others
square (X)           plan; circle (B): execute
triangle, cross (Y, A)   the next and the last tip of the group; select, start: the next and the last group
"""

from __future__ import annotations

import threading
from typing import Any
from xml.etree import ElementTree

import lenient_xml
import node_signals
import numpy as np
import rospy
from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import Joy
from std_msgs.msg import Empty, String
from tf.transformations import quaternion_from_euler, quaternion_matrix, quaternion_multiply
from visualization_msgs.msg import InteractiveMarkerInit

from moveit_ros_visualization import gamepads

_SPEED, _TURN = 0.2, 0.4  # m/s, rad/s
_LEASH = 0.1  # m that the goal may be away from where the hand can go
_PAUSE = 0.3  # s without a command after which the goal begins again where the panel has it
_MARKERS = "/rviz_moveit_motion_planning_display/robot_interaction_interactive_marker_topic/update_full"
_GOAL = "EE:goal_"


def main() -> int:
    """Run the node; the exit code. ``~link``: the tip that is moved at first; default the group's first."""
    node_signals.init_node("moveit_joy")
    Joystick(str(rospy.get_param("~link", "")).strip("/"))
    node_signals.spin()
    return 0


def groups_with_solver() -> list[str]:
    """Planning groups whose inverse kinematics is configured, as the SRDF orders them."""
    try:
        root = lenient_xml.fromstring(rospy.get_param("robot_description_semantic", "<robot/>"))
    except ElementTree.ParseError:
        return []
    solvers = rospy.get_param("robot_description_kinematics", {})
    return [name for name in (group.get("name", "") for group in root.findall("group")) if name in solvers]


class Joystick:
    """Turns Joy messages into poses of the goal and commands."""

    def __init__(self, link: str):
        self._link, self._group = link, 0
        self._markers: dict[str, PoseStamped] = {}  # by link
        self._goal: PoseStamped | None = None  # where it was sent last
        self._before: frozenset[Any] = frozenset()
        self._time = self._moved = rospy.Time()
        self._lock = threading.Lock()
        self._poses: dict[str, rospy.Publisher] = {}
        self._commands = {
            name: rospy.Publisher("/rviz/moveit/" + name, Empty, queue_size=5) for name in ("plan", "execute", "update_start_state")
        }
        self._groups = rospy.Publisher("/rviz/moveit/select_planning_group", String, queue_size=5)
        self._subscribers = [
            rospy.Subscriber(_MARKERS, InteractiveMarkerInit, self._on_markers, queue_size=1),
            rospy.Subscriber("joy", Joy, self._on_joy, queue_size=1),
        ]

    def _on_markers(self, message: InteractiveMarkerInit) -> None:
        with self._lock:
            self._markers = {
                marker.name[len(_GOAL) :]: PoseStamped(header=marker.header, pose=marker.pose)
                for marker in message.markers
                if marker.name.startswith(_GOAL)
            }
            for link in self._markers:  # now, for a publisher needs time to be known
                if link not in self._poses:
                    self._poses[link] = rospy.Publisher("/rviz/moveit/move_marker/goal_" + link, PoseStamped, queue_size=1)

    def _on_joy(self, message: Joy) -> None:
        controls = gamepads.read(message)
        if controls is None:
            rospy.logerr_throttle(
                30,
                f"no gamepad with {len(message.axes)} axes and {len(message.buttons)} buttons is known; "
                f"known are {', '.join(f'{a} and {b}' for a, b in sorted(gamepads.PADS))}",
            )
            return
        now = rospy.Time.now()
        passed = min(max((now - self._time).to_sec(), 0.0), 0.1)
        self._time = now
        new, self._before = controls.pressed - self._before, controls.pressed
        with self._lock:
            if not self._command(new):
                self._move(controls, passed)

    def _command(self, new: frozenset) -> bool:
        """Do what a button says that was just pressed."""
        for button, name in (("square", "plan"), ("circle", "execute")):
            if button in new:
                if name == "plan":
                    self._commands["update_start_state"].publish()
                self._commands[name].publish()
                return True
        step = 1 if new & {"triangle", "select"} else -1
        if new & {"select", "start"}:
            self._choose_group(step)
        elif new & {"triangle", "cross"}:
            self._choose_tip(step)
        else:
            return False
        return True

    def _choose_group(self, step: int) -> None:
        names = groups_with_solver()
        if not names:
            rospy.logwarn(
                "no group below the parameter %s: is move_group's launch file running?", rospy.resolve_name("robot_description_kinematics")
            )
            return
        self._group = (self._group + step) % len(names)
        rospy.loginfo("Planning group: %s", names[self._group])
        self._groups.publish(names[self._group])
        self._link, self._goal = "", None

    def _choose_tip(self, step: int) -> None:
        links = sorted(self._markers)
        if links:
            self._link = links[(links.index(self._tip()) + step) % len(links)]
            self._goal = None
            rospy.loginfo("The goal of '%s' is moved", self._link)

    def _tip(self) -> str:
        return self._link if self._link in self._markers else min(self._markers)

    def _move(self, controls: gamepads.Controls, passed: float) -> None:
        def way(more: str, less: str) -> float:
            return float(more in controls.pressed) - float(less in controls.pressed)

        shift = _SPEED * passed * np.array((controls.stick[1], controls.stick[0], way("L2", "R2")))
        turn = _TURN * passed * np.array((way("right", "left"), way("up", "down"), way("L1", "R1")))
        if not shift.any() and not turn.any():
            return
        if not self._markers:
            rospy.logwarn_throttle(
                10, "RViz has no goal to move: is MotionPlanning shown there, with 'Query Goal State' and a group that has a solver?"
            )
            return
        link, now = self._tip(), rospy.Time.now()
        shown = self._markers[link]
        if self._goal is None or (now - self._moved).to_sec() > _PAUSE or self._goal.header.frame_id != shown.header.frame_id:
            self._goal = shown
        self._moved = now
        self._goal = _moved(self._goal, shift, turn, shown)
        publisher = self._poses[link]
        if publisher.get_num_connections():
            publisher.publish(self._goal)
        else:
            rospy.logwarn_throttle(10, "nobody listens on %s: check 'External Comm.' in RViz's MotionPlanning panel", publisher.name)


def _moved(goal: PoseStamped, shift: np.ndarray, turn: np.ndarray, shown: PoseStamped) -> PoseStamped:
    """The goal shifted and turned in its own axes, not farther than a leash's length from what is shown."""
    was, there = goal.pose, shown.pose.position
    turned = np.array((was.orientation.x, was.orientation.y, was.orientation.z, was.orientation.w))
    position = np.array((was.position.x, was.position.y, was.position.z)) + quaternion_matrix(turned)[:3, :3] @ shift
    hand = np.array((there.x, there.y, there.z))
    away = np.linalg.norm(position - hand)
    if away > _LEASH:
        position = hand + (position - hand) * (_LEASH / away)
    pose = PoseStamped()
    pose.header.frame_id = goal.header.frame_id
    pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = position
    new = pose.pose.orientation
    new.x, new.y, new.z, new.w = quaternion_multiply(turned, quaternion_from_euler(*turn))
    return pose
