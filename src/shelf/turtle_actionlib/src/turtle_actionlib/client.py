"""The node test_shape: lets a pentagon be drawn."""

import actionlib
import node_signals
import rospy
from actionlib_msgs.msg import GoalStatus

from .msg import ShapeAction, ShapeGoal

PATIENCE = 40.0  # s


def main() -> int:
    node_signals.init_node("test_shape")
    client = actionlib.SimpleActionClient("turtle_shape", ShapeAction)
    rospy.loginfo("Waiting for action server to start.")
    while not client.wait_for_server(rospy.Duration(0.5)):
        if rospy.is_shutdown():
            return 0
    rospy.loginfo("Action server started, sending goal.")
    client.send_goal(ShapeGoal(edges=5, radius=1.3))
    if client.wait_for_result(rospy.Duration(PATIENCE)):
        rospy.loginfo("Action finished: %s", GoalStatus.to_string(client.get_state()))
    elif not rospy.is_shutdown():
        rospy.loginfo("Action did not finish before the time out.")
    return 0
