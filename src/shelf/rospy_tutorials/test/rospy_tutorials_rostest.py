#!/usr/bin/env python3
"""Each of the nodes as a course types it."""

import subprocess
import unittest

import rospy
import rostest
from rosgraph_msgs.msg import Log
from rospy_tutorials.msg import Floats, HeaderString
from rospy_tutorials.srv import AddTwoInts, BadTwoInts
from std_msgs.msg import String
from test_support import wait_until


def typed(*words):
    return subprocess.run(["rosrun", "rospy_tutorials", *words], capture_output=True, text=True, timeout=60)


class Tutorials(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.log = []
        cls.subscriber = rospy.Subscriber("/rosout", Log, lambda message: cls.log.append((message.name, message.msg)))

    def logged(self, node, *parts):
        wait_until(lambda: any(name == node and all(part in text for part in parts) for name, text in self.log), f"{parts} of {node}")

    def test_talker_and_listener(self):
        first = rospy.wait_for_message("/chatter", String, timeout=60).data
        self.assertRegex(first, r"^hello world \d+\.\d+$")
        self.assertRegex(rospy.wait_for_message("/timed", String, timeout=60).data, r"^hello world \d+\.\d+$")
        self.logged("/listener", "/listenerI heard hello world")

    def test_headers(self):
        first, second = (rospy.wait_for_message("/chatter_header", HeaderString, timeout=60) for _ in range(2))
        self.assertGreater(second.header.seq, first.header.seq)
        self.assertGreater(second.header.stamp, first.header.stamp)
        self.logged("/listener_header", "just heard hello world")

    def test_two_ints_are_added(self):
        asked = typed("add_two_ints_client", "40", "-2")
        self.assertEqual((asked.returncode, asked.stdout), (0, "Requesting 40+-2\n40 + -2 = 38\n"))
        self.assertEqual(rospy.ServiceProxy("add_two_ints", AddTwoInts)(2**62, -1).sum, 2**62 - 1)
        self.assertRegex(typed("add_two_ints_client").stdout, r"^Requesting -?\d+\+-?\d+\n-?\d+ \+ -?\d+ = -?\d+\n$")
        wrong = typed("add_two_ints_client", "1", "two")
        self.assertEqual(wrong.returncode, 1)
        self.assertEqual(len(wrong.stderr.splitlines()), 1)

    def test_parameters(self):
        self.assertEqual(rospy.wait_for_message("/foo/chatter", String, timeout=60).data, "Hello World")
        self.logged("/foo/param_talker", "Hello World")
        self.assertEqual(rospy.get_param("/foo/param_talker/private_bar"), 3)
        self.assertFalse(rospy.has_param("/foo/to_delete"))

    def test_types_are_upstreams(self):
        self.assertEqual(
            [kind._md5sum for kind in (AddTwoInts, BadTwoInts, Floats, HeaderString)],
            [
                "6a2e34150c00229791cc89ff309fff21",
                "60962375a49bd6746d7c85dff75ebb9c",
                "420cd38b6b071cd49f2970c3e2cee511",
                "c99a9440709e4d4a9716d55b8270d5e7",
            ],
        )


if __name__ == "__main__":
    rospy.init_node("tutorials_test")
    rostest.rosrun("rospy_tutorials", "rospy_tutorials", Tutorials)
