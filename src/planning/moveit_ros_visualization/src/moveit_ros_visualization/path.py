"""The planned path: a ghost that runs along it three times as fast, and the line of the hand."""
from __future__ import annotations

import threading
from typing import List

import rospy
from geometry_msgs.msg import Point
from moveit_msgs.msg import DisplayTrajectory
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from moveit_core import states

from .ghost import BLUE, ghost

_STEP = 0.05  # wall s between two pictures
_FASTER = 3.0


class PathGhost:
    """Shows what move_group planned last, once."""

    def __init__(self, robot, link: str):
        self._robot, self._link = robot, link
        self._news = threading.Event()
        self._end = False
        self._message = None
        self._publisher = rospy.Publisher("goal_marker/path", MarkerArray, queue_size=1)
        self._subscriber = rospy.Subscriber("move_group/display_planned_path", DisplayTrajectory, self._received,
                                            queue_size=10)
        threading.Thread(target=self._run, name="path ghost", daemon=True).start()

    def shutdown(self) -> None:
        """Stop showing."""
        self._end = True
        self._news.set()

    def _received(self, message: DisplayTrajectory) -> None:
        self._message = message
        self._news.set()

    def _run(self) -> None:
        while not self._end and not rospy.is_shutdown():
            self._news.wait()
            self._news.clear()
            message = self._message
            if message is None or message.model_id not in ("", self._robot.model.name):
                continue
            try:
                self._play(message)
            except (ValueError, LookupError) as error:
                rospy.logwarn("a path that came cannot be shown: %s", error)

    def _play(self, message: DisplayTrajectory) -> None:
        shown = self._frames(message)
        line = self._line([state.pose(self._link) for state in shown])
        for state in shown:
            picture = ghost(self._robot.description, state, BLUE, "path")
            picture.markers.append(line)
            self._publisher.publish(picture)
            if self._news.wait(_STEP) or self._end:
                return
        self._publisher.publish(MarkerArray([Marker(ns="path", id=number, action=Marker.DELETE) for number in
                                             range(len(ghost(self._robot.description, shown[-1], BLUE,
                                                             "path").markers))]))

    def _frames(self, message: DisplayTrajectory) -> List:
        """States of the path, as far apart as the pictures are."""
        state, frames, due = self._robot.model.state(), [], 0.0
        states.apply_robot_state(None, state, message.trajectory_start)
        for trajectory in message.trajectory:
            names, points = trajectory.joint_trajectory.joint_names, trajectory.joint_trajectory.points
            for number, point in enumerate(points):
                now = point.time_from_start.to_sec()
                if now < due and number + 1 < len(points):
                    continue
                due = now + _STEP * _FASTER
                state.set(dict(zip(names, point.positions)))
                frames.append(state.copy())
        return frames or [state]

    def _line(self, poses) -> Marker:
        line = Marker(ns="tip", type=Marker.LINE_STRIP, action=Marker.ADD, color=ColorRGBA(0.35, 0.6, 1.0, 1.0))
        line.header.frame_id, line.scale.x, line.pose.orientation.w = self._robot.model.frame, 0.005, 1.0
        line.points = [Point(*(float(value) for value in pose.position)) for pose in poses]
        return line
