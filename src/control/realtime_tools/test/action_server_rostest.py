#!/usr/bin/env python3
"""The action server and a simulation clock that jumps back."""

import threading
import time
import unittest

import rospy
import rostest
from actionlib_msgs.msg import GoalStatusArray
from control_msgs.msg import GripperCommandAction
from realtime_tools.action_server import RealtimeActionServer
from rosgraph_msgs.msg import Clock


class ActionServerTest(unittest.TestCase):
    def setUp(self):
        self.died = []
        threading.excepthook, hook = lambda args: self.died.append(args.exc_value), threading.excepthook
        self.addCleanup(setattr, threading, "excepthook", hook)
        self.clock = rospy.Publisher("/clock", Clock, queue_size=100)
        self.now = 100.0

    def wait(self, condition, what, step=0.01):
        """Let ``step`` s of simulated time pass again and again until ``condition`` is true."""
        deadline = time.monotonic() + 60.0
        while not condition():
            self.assertLess(time.monotonic(), deadline, what)
            self.now += step
            self.clock.publish(Clock(rospy.Time.from_sec(self.now)))
            time.sleep(0.005)

    def test_goes_on_when_the_clock_jumps_back_and_no_thread_dies(self):
        self.wait(lambda: rospy.get_time() >= 100.0, "the clock")
        server = RealtimeActionServer("/act", GripperCommandAction, lambda goal: None, lambda goal_id: None)
        self.addCleanup(server.shutdown)
        stamps = []
        rospy.Subscriber("/act/status", GoalStatusArray, lambda message: stamps.append(message.header.stamp.to_sec()))
        self.wait(lambda: len(stamps) > 2, "status before the jump")
        self.now = 1.0
        self.wait(lambda: stamps and 1.0 < stamps[-1] < 50.0, "status after the jump")
        count = len(stamps)
        self.wait(lambda: len(stamps) > count + 2, "more status after the jump")
        self.assertEqual(self.died, [])

    def test_shut_down_just_before_the_clock_jumps_back_leaves_no_thread_that_dies(self):
        self.wait(lambda: rospy.get_time() >= 100.0, "the clock")
        before = set(threading.enumerate())
        server = RealtimeActionServer("/act2", GripperCommandAction, lambda goal: None, lambda goal_id: None)
        timers = [thread for thread in threading.enumerate() if isinstance(thread, rospy.Timer) and thread not in before]
        server.shutdown()
        self.now = 1.0
        self.wait(lambda: not any(timer.is_alive() for timer in timers), "the end of the timers")
        self.assertEqual(self.died, [])


if __name__ == "__main__":
    rospy.init_node("action_server_test")
    rostest.rosrun("realtime_tools", "action_server", ActionServerTest)
