#!/usr/bin/env python3
"""A goal is drawn, another is refused, one is cancelled; shape_client finds the server."""

import subprocess
import unittest

import actionlib
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from std_srvs.srv import Empty
from turtle_actionlib.msg import ShapeAction, ShapeGoal
from turtlesim.msg import Pose

MINUTE = rospy.Duration(60)


class TurtleActionlib(unittest.TestCase):
    def setUp(self):
        rospy.wait_for_service("/reset", timeout=60)
        rospy.ServiceProxy("/reset", Empty)()
        self.client = actionlib.SimpleActionClient("turtle_shape", ShapeAction)
        self.assertTrue(self.client.wait_for_server(MINUTE))
        rospy.wait_for_message("/turtle1/pose", Pose, timeout=60)

    def test_drawn(self):
        self.assertEqual(self.client.send_goal_and_wait(ShapeGoal(3, 0.02), MINUTE), GoalStatus.SUCCEEDED)
        result = self.client.get_result()
        self.assertAlmostEqual(result.interior_angle, 1.0471975, places=5)
        self.assertAlmostEqual(result.apothem, 0.01, places=5)

    def test_refused(self):
        self.assertEqual(self.client.send_goal_and_wait(ShapeGoal(2, 1), MINUTE), GoalStatus.ABORTED)
        self.assertEqual(self.client.get_goal_status_text(), "a shape has 3 edges or more, not 2")

    def test_cancelled(self):
        self.client.send_goal(ShapeGoal(5, 1.3))
        while rospy.wait_for_message("/turtle1/pose", Pose, timeout=60).linear_velocity == 0:
            pass
        self.client.cancel_goal()
        self.assertTrue(self.client.wait_for_result(MINUTE))
        self.assertEqual(self.client.get_state(), GoalStatus.PREEMPTED)
        self.assertLess(rospy.wait_for_message("/turtle1/pose", Pose, timeout=60).x, 8)  # it stands, well before the wall

    def test_client(self):
        client = subprocess.Popen(["rosrun", "turtle_actionlib", "shape_client"], stdout=subprocess.PIPE, text=True)
        try:
            said = [client.stdout.readline() for _ in range(2)]
            self.assertIn("Action server started, sending goal.", said[1])
            while rospy.wait_for_message("/turtle1/pose", Pose, timeout=60).linear_velocity == 0:
                pass
        finally:
            client.terminate()
            client.communicate()
            self.client.cancel_all_goals()


if __name__ == "__main__":
    rospy.init_node("turtle_actionlib_rostest")
    rostest.rosrun("turtle_actionlib", "turtle_actionlib", TurtleActionlib)
