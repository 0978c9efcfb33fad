"""The topics below ``/rviz/moveit`` with which programs and joysticks use the goal marker, as they do RViz's panel."""
from __future__ import annotations

import rospy
from geometry_msgs.msg import PoseStamped
from moveit_msgs.msg import RobotState
from std_msgs.msg import Empty


class ExternalTopics:
    """``plan``, ``execute``, ``stop`` and ``update_goal_state`` (to the current state), of type Empty;
    ``update_custom_goal_state`` and ``move_marker/goal_LINK``."""

    def __init__(self, goal):
        self._goal = goal
        self._subscribers = [
            self._on("plan", Empty, lambda _message: goal.plan()),
            self._on("execute", Empty, lambda _message: goal.execute()),
            self._on("stop", Empty, lambda _message: goal.stop()),
            self._on("update_goal_state", Empty, lambda _message: goal.to_current()),
            self._on("update_custom_goal_state", RobotState, goal.to_state),
            self._on(f"move_marker/goal_{goal.link}", PoseStamped, goal.to_pose)]

    @staticmethod
    def _on(name: str, kind, callback) -> rospy.Subscriber:
        return rospy.Subscriber("/rviz/moveit/" + name, kind, callback, queue_size=1)

    def shutdown(self) -> None:
        """Listen no longer."""
        for subscriber in self._subscribers:
            subscriber.unregister()
