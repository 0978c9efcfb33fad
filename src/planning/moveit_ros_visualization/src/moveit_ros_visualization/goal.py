"""The goal: an interactive marker at the hand, the ghost of the robot that reaches it, and a menu."""
from __future__ import annotations

import threading
from typing import Callable, Optional

import motion
import rospy
from geometry_msgs.msg import Pose, PoseStamped, Quaternion
from interactive_markers.interactive_marker_server import InteractiveMarkerServer
from interactive_markers.menu_handler import MenuHandler
from moveit_msgs.msg import Constraints, RobotState
from moveit_msgs.srv import GetStateValidity
from std_msgs.msg import ColorRGBA
from std_srvs.srv import Empty
from visualization_msgs.msg import (InteractiveMarker, InteractiveMarkerControl, InteractiveMarkerFeedback, Marker,
                                    MarkerArray)

from moveit_core import convert, states

from .ghost import ORANGE, RED, ghost

_NAME = "goal"
#: orientations that turn a control's x axis to x, z and y
_AXES = {"x": (1.0, 0.0, 0.0, 1.0), "z": (0.0, 1.0, 0.0, 1.0), "y": (0.0, 0.0, 1.0, 1.0)}


class GoalMarker:
    """Drag it, and the ghost follows where inverse kinematics finds a way; red: no way, or something would touch."""

    def __init__(self, robot, group):
        self._robot, self._group = robot, group
        self._model, self._link = robot.model, group.get_end_effector_link()
        settings = robot.description.kinematics.get(group.get_name())
        self._position_only = settings is not None and settings.position_only
        self._lock = threading.Lock()
        self._busy = threading.Lock()
        self._plan = None
        self._state: motion.RobotState = self._current()
        self._pose_publisher = rospy.Publisher("goal_marker/pose", PoseStamped, queue_size=1, latch=True)
        self._publisher = rospy.Publisher("goal_marker/goal", MarkerArray, queue_size=1, latch=True)
        self._server = InteractiveMarkerServer("goal_marker")
        self._menu = self._make_menu()
        self._insert(self._state.pose(self._link))
        self._show()

    @property
    def link(self) -> str:
        """The link whose goal this is."""
        return self._link

    # --- what the menu and the topics below /rviz/moveit do ---

    def plan(self) -> None:
        """Plan to the goal, in the background."""
        self._in_background(self._do_plan)(None)

    def execute(self) -> None:
        """Execute what was planned last, in the background."""
        self._in_background(self._do_execute)(None)

    def stop(self) -> None:
        """Stop the motion."""
        self._group.stop()

    def to_current(self) -> None:
        """Set the goal to where the robot is."""
        self._set(self._current())

    def to_state(self, message: RobotState) -> None:
        """Set the goal to the joint values of a message."""
        state = self._state.copy()
        try:
            states.apply_robot_state(None, state, message)
        except (motion.MotionError, ValueError) as error:
            rospy.logwarn("goal: %s", error)
            return
        self._set(state)

    def to_pose(self, message: PoseStamped) -> None:
        """Set the goal to a pose in the model's frame."""
        frame = message.header.frame_id.lstrip("/")
        if frame not in ("", self._model.frame):
            rospy.logwarn_throttle(5, f"goal: poses are expected in '{self._model.frame}', not in '{frame}'")
            return
        try:
            pose = convert.pose_message(convert.pose(message.pose, "a goal"))
        except (motion.MotionError, ValueError) as error:
            rospy.logwarn_throttle(5, f"goal: {error}")
            return
        self._follow(pose)
        self._server.setPose(_NAME, pose)
        self._server.applyChanges()

    def shutdown(self) -> None:
        """Take the marker away."""
        self._server.clear()
        self._server.applyChanges()

    def _current(self) -> motion.RobotState:
        state = self._model.state()
        states.apply_robot_state(None, state, self._robot.get_current_state())
        return state

    # --- the marker ---

    def _insert(self, pose) -> None:
        marker = InteractiveMarker(name=_NAME, description=f"goal of {self._group.get_name()}", scale=0.3)
        marker.header.frame_id, marker.pose = self._model.frame, convert.pose_message(pose)
        ball = Marker(type=Marker.SPHERE, color=ColorRGBA(0.0, 1.0, 1.0, 0.5))
        ball.scale.x = ball.scale.y = ball.scale.z = 0.08
        marker.controls.append(InteractiveMarkerControl(name="ball", always_visible=True, markers=[ball],
                                                        orientation=Quaternion(0, 0, 0, 1),
                                                        interaction_mode=InteractiveMarkerControl.MOVE_ROTATE_3D))
        for axis, turn in _AXES.items():
            length = sum(value * value for value in turn) ** 0.5
            quaternion = Quaternion(*(value / length for value in turn))
            for name, mode in (("move", InteractiveMarkerControl.MOVE_AXIS), ("rotate",
                                                                              InteractiveMarkerControl.ROTATE_AXIS)):
                marker.controls.append(InteractiveMarkerControl(name=f"{name}_{axis}", orientation=quaternion,
                                                                interaction_mode=mode))
        self._server.insert(marker, self._feedback)
        self._menu.apply(self._server, _NAME)
        self._server.applyChanges()

    def _feedback(self, feedback: InteractiveMarkerFeedback) -> None:
        if feedback.event_type == InteractiveMarkerFeedback.POSE_UPDATE:
            self._follow(feedback.pose)
        elif feedback.event_type == InteractiveMarkerFeedback.MOUSE_UP:
            self._show(self._problem())

    def _follow(self, pose: Pose) -> None:
        with self._lock:
            try:
                found = motion.ik(self._model, self._group.get_name(), convert.pose(pose), link=self._link,
                                  seed=self._state, timeout=0.05, position_only=self._position_only)
            except (motion.MotionError, ValueError) as error:
                rospy.logwarn_throttle(5, f"goal: {error}")
                return
            if found:
                self._state.set_group(self._group.get_name(), found.solutions[0])
        self._show("" if found else found.message)

    def _problem(self) -> str:
        """Why the goal cannot be; "" if it can."""
        try:
            answer = rospy.ServiceProxy("check_state_validity", GetStateValidity)(
                states.robot_state_message(self._state, attached=False), self._group.get_name(), Constraints())
        except rospy.ServiceException as error:
            return str(error)
        if answer.valid:
            return ""
        contact = answer.contacts[0] if answer.contacts else None
        return f"'{contact.contact_body_1}' touches '{contact.contact_body_2}'" if contact else "the goal is not valid"

    def _show(self, problem: str = "") -> None:
        if problem:
            rospy.logwarn_throttle(2, f"goal: {problem}")
        with self._lock:
            pose = PoseStamped(pose=convert.pose_message(self._state.pose(self._link)))
            pose.header.frame_id, pose.header.stamp = self._model.frame, rospy.Time.now()
            self._pose_publisher.publish(pose)
            self._publisher.publish(ghost(self._robot.description, self._state, RED if problem else ORANGE, "goal"))

    # --- the menu ---

    def _make_menu(self) -> MenuHandler:
        menu = MenuHandler()
        for title, action in (("Plan", self._do_plan), ("Execute", self._do_execute), ("Plan && Execute", self._do_both)):
            menu.insert(title, callback=self._in_background(action))
        menu.insert("Stop", callback=lambda _feedback: self.stop())
        goals = menu.insert("Set goal to")
        menu.insert("current", parent=goals, callback=lambda _feedback: self.to_current())
        menu.insert("random", parent=goals, callback=lambda _feedback: self._set_random())
        for name in self._model.group(self._group.get_name()).named_states:
            menu.insert(name, parent=goals, callback=lambda _feedback, name=name: self._set_named(name))
        menu.insert("Clear octomap", callback=lambda _feedback: rospy.ServiceProxy("clear_octomap", Empty)())
        return menu

    def _in_background(self, action: Callable[[], None]) -> Callable:
        def start(_feedback) -> None:
            if not self._busy.acquire(blocking=False):
                rospy.logwarn("the last plan or motion is not over yet; Stop ends it")
                return
            threading.Thread(target=self._run, args=(action,), name="goal marker", daemon=True).start()
        return start

    def _run(self, action: Callable[[], None]) -> None:
        try:
            self._group.set_joint_value_target([float(value)
                                                for value in self._state.get_group(self._group.get_name())])
            action()
        finally:
            self._busy.release()

    def _do_plan(self) -> None:
        good, plan, _, _ = self._group.plan()
        self._plan = plan if good else None

    def _do_execute(self) -> None:
        if self._plan is None:
            rospy.logwarn("nothing is planned that could be executed: choose Plan first")
        else:
            self._group.execute(self._plan)

    def _do_both(self) -> None:
        self._group.go()

    def _set(self, state: Optional[motion.RobotState]) -> None:
        with self._lock:
            self._state = state
            pose = state.pose(self._link)
        self._server.setPose(_NAME, convert.pose_message(pose))
        self._server.applyChanges()
        self._show(self._problem())

    def _set_random(self) -> None:
        state = self._state.copy()
        state.randomize(self._group.get_name())
        self._set(state)

    def _set_named(self, name: str) -> None:
        state = self._state.copy()
        state.set_named(self._group.get_name(), name)
        self._set(state)
