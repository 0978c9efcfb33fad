"""What the clients share: a goal is sent, and how it ended is told."""

from typing import Any

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus

PATIENCE = 30.0  # s


def ask(name: str, kind: type, goal: Any) -> actionlib.SimpleActionClient | None:
    """Send ``goal`` to the action ``name`` of class ``kind`` once its server is there; None if the node ends before."""
    client = actionlib.SimpleActionClient(name, kind)
    rospy.loginfo("Waiting for action server to start.")
    if not client.wait_for_server():
        return None
    rospy.loginfo("Action server started, sending goal.")
    client.send_goal(goal)
    return client


def tell_state(client: actionlib.SimpleActionClient | None) -> None:
    """How ``client``'s goal ended, or that it did not within :data:`PATIENCE`."""
    if client is None:
        return
    if client.wait_for_result(rospy.Duration(PATIENCE)):
        rospy.loginfo("Action finished: %s", GoalStatus.to_string(client.get_state()))
    elif not rospy.is_shutdown():
        rospy.loginfo("Action did not finish before the time out.")
