#!/usr/bin/env python3
"""Each of the nodes as a course types it."""

import subprocess
import unittest

import rospy
import rostest
from roscpp_tutorials.srv import TwoInts
from rosgraph_msgs.msg import Log
from std_msgs.msg import String
from test_support import wait_until


def typed(*words):
    return subprocess.run(["rosrun", "roscpp_tutorials", *words], capture_output=True, text=True, timeout=60)


class Tutorials(unittest.TestCase):
    def test_talker_and_listener(self):
        log = []
        subscriber = rospy.Subscriber("/rosout", Log, lambda message: log.append((message.name, message.msg)))
        self.assertRegex(rospy.wait_for_message("/chatter", String, timeout=60).data, r"^hello world \d+$")
        wait_until(lambda: any(name == "/listener" and text.startswith("I heard: [hello world ") for name, text in log), "the listener")
        subscriber.unregister()

    def test_two_ints_are_added(self):
        rospy.wait_for_service("add_two_ints", timeout=60)
        self.assertEqual(TwoInts._md5sum, "6a2e34150c00229791cc89ff309fff21")
        self.assertEqual(rospy.ServiceProxy("add_two_ints", TwoInts)(2**62, -1).sum, 2**62 - 1)
        asked = typed("add_two_ints_client", "1", "3")
        self.assertEqual(asked.returncode, 0)
        self.assertIn("Sum: 4", asked.stdout)
        wrong = typed("add_two_ints_client", "1")
        self.assertEqual(wrong.returncode, 1)
        self.assertIn("usage: add_two_ints_client X Y", wrong.stdout)


if __name__ == "__main__":
    rospy.init_node("tutorials_test")
    rostest.rosrun("roscpp_tutorials", "roscpp_tutorials", Tutorials)
