#!/usr/bin/env python3
"""Goals that succeed, are cancelled and fail; the client as it is typed."""

import statistics
import subprocess
import unittest

import actionlib
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from actionlib_tutorials.msg import AveragingAction, AveragingGoal, FibonacciAction, FibonacciActionFeedback, FibonacciGoal
from std_msgs.msg import Float32
from test_support import wait_until
from test_support.hearing import heard

MINUTE = rospy.Duration(60)


class Tutorials(unittest.TestCase):
    def client(self, name, kind):
        client = actionlib.SimpleActionClient(name, kind)
        self.assertTrue(client.wait_for_server(MINUTE))
        ends = client.action_client
        wait_until(lambda: heard([ends.status_sub, ends.feedback_sub, ends.result_sub]), "all that the server sends")
        return client

    def test_fibonacci(self):
        told = []  # by the topic: a SimpleActionClient drops what comes before its send_goal() returns, as the first may
        client = self.client("fibonacci", FibonacciAction)
        feedback = rospy.Subscriber("/fibonacci/feedback", FibonacciActionFeedback, lambda m: told.append(list(m.feedback.sequence)))
        self.addCleanup(feedback.unregister)
        wait_until(lambda: heard([feedback]), "the server's feedback")
        client.send_goal(FibonacciGoal(order=4))
        self.assertTrue(client.wait_for_result(MINUTE))
        self.assertEqual(client.get_state(), GoalStatus.SUCCEEDED)
        self.assertEqual(list(client.get_result().sequence), [0, 1, 1, 2, 3])
        wait_until(lambda: len(told) == 3, "three feedbacks")
        self.assertEqual(told, [[0, 1, 1], [0, 1, 1, 2], [0, 1, 1, 2, 3]])

    def test_fibonacci_is_cancelled(self):
        told = []
        client = self.client("fibonacci", FibonacciAction)
        client.send_goal(FibonacciGoal(order=1000), feedback_cb=told.append)
        wait_until(lambda: told, "the first number")
        client.cancel_goal()
        self.assertTrue(client.wait_for_result(MINUTE))
        self.assertEqual(client.get_state(), GoalStatus.PREEMPTED)

    def test_the_client_averages_what_is_generated(self):
        asked = subprocess.run(["rosrun", "actionlib_tutorials", "averaging_client"], capture_output=True, text=True, timeout=90)
        self.assertEqual(asked.returncode, 0, asked.stderr)
        self.assertRegex(asked.stdout, "Action finished: (SUCCEEDED|ABORTED)")  # by the mean, which is 5 give or take 0.1

    def test_mean_and_deviation(self):
        heard, told = [], []
        subscriber = rospy.Subscriber("/random_number", Float32, lambda message: heard.append(message.data))
        client = self.client("averaging", AveragingAction)
        client.send_goal(AveragingGoal(samples=10), feedback_cb=lambda feedback: told.append(feedback.data))
        self.assertTrue(client.wait_for_result(MINUTE))
        subscriber.unregister()
        result = client.get_result()
        self.assertEqual(len(told), 10)
        self.assertAlmostEqual(result.mean, statistics.fmean(told), places=4)
        self.assertAlmostEqual(result.std_dev, statistics.pstdev(told), places=3)
        self.assertEqual(client.get_state(), GoalStatus.ABORTED if result.mean < 5.0 else GoalStatus.SUCCEEDED)


if __name__ == "__main__":
    rospy.init_node("tutorials_test")
    rostest.rosrun("actionlib_tutorials", "actionlib_tutorials", Tutorials)
