#!/usr/bin/env python3
"""A person at a screen: opens Robot Steering from rqt's menu, types a topic, drives turtlesim's turtle by keys, and stops it."""

import queue
import unittest

import rospy
import rostest
from rqt_testing.desktop import Desktop
from turtlesim.msg import Pose


class DrivesTurtle(unittest.TestCase):
    def wait_for_speed(self, poses, matches):
        """The first of many poses whose speed is right."""
        for _ in range(3000):
            pose = poses.get(timeout=60)
            if matches(pose.linear_velocity):
                return
        self.fail(f"the turtle goes at {pose.linear_velocity} m/s")

    def test_keys(self):
        poses = queue.Queue()
        rospy.Subscriber("/turtle1/pose", Pose, poses.put)
        with Desktop() as desktop:
            rqt = desktop.run(["rqt"])
            rqt.window("rqt")
            rqt.choose("Plugins", "Robot Tools", "Robot Steering")
            rqt.click("topic_line_edit")
            desktop.keys("ctrl+a")
            desktop.type("/turtle1/cmd_vel\n")
            rqt.click("x_linear_slider")
            rqt.click("reset_x_linear_push_button")
            desktop.keys("shift+w", "w")
            rqt.wait(lambda: rqt.text("current_x_label") == "0.11 m/s")
            self.wait_for_speed(poses, lambda speed: abs(speed - 0.11) < 1e-6)
            desktop.keys("space")
            rqt.wait(lambda: rqt.text("current_x_label") == "0.00 m/s")
            self.wait_for_speed(poses, lambda speed: speed == 0)
            self.assertEqual(rqt.end(), 0)
            self.assertEqual(rqt.output(), "")


if __name__ == "__main__":
    rospy.init_node("drives_turtle_rostest")
    rostest.rosrun("rqt_robot_steering", "drives_turtle", DrivesTurtle)
