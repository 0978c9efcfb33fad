#!/usr/bin/env python3
"""The beginner's tutorial, typed: turtlesim_node, turtle_teleop_key, draw_square, mimic, and every service."""

import math
import queue
import subprocess
import unittest

import pexpect
import rospy
import rostest
from geometry_msgs.msg import Twist
from rosgraph_msgs.msg import Log
from std_srvs.srv import Empty
from turtlesim.msg import Color, Pose
from turtlesim.srv import Kill, SetPen, Spawn, TeleportAbsolute, TeleportRelative


def call(name, kind, *values):
    rospy.wait_for_service(name, timeout=60)
    return rospy.ServiceProxy(name, kind)(*values)


def wait_for(topic, kind, condition, messages=2000):
    """The first message that fulfils the condition."""
    seen = queue.Queue()
    subscriber = rospy.Subscriber(topic, kind, seen.put)
    try:
        for _ in range(messages):
            message = seen.get(timeout=60)
            if condition(message):
                return message
        raise AssertionError(f"no message of {topic} in {messages}; the last: {message}")
    finally:
        subscriber.unregister()


class Turtlesim(unittest.TestCase):
    def setUp(self):
        call("/reset", Empty)

    def pose(self, x, y, theta, tolerance=1e-4):
        return wait_for("/turtle1/pose", Pose, lambda p: max(abs(p.x - x), abs(p.y - y), abs(p.theta - theta)) < tolerance)

    def log(self, text, level=Log.INFO):
        return lambda record: record.name == "/turtlesim" and record.msg == text and record.level == level

    def test_topics_and_parameters(self):
        types = dict(rospy.get_published_topics())
        self.assertEqual((types["/turtle1/pose"], types["/turtle1/color_sensor"]), ("turtlesim/Pose", "turtlesim/Color"))
        self.assertEqual([rospy.get_param("/turtlesim/background_" + c) for c in "rgb"], [69, 86, 255])
        self.pose(5.544445, 5.544445, 0)

    def test_steps(self):
        """A turtle that is told to go covers 0.016 s of way per step."""
        stop = rospy.Publisher("/turtle1/cmd_vel", Twist, queue_size=1, latch=True)
        twist = Twist()
        twist.linear.x = 1.0
        stop.publish(twist)
        first = wait_for("/turtle1/pose", Pose, lambda p: p.linear_velocity == 1.0)
        second = wait_for("/turtle1/pose", Pose, lambda p: p.x > first.x + 0.2)
        steps = (second.x - first.x) / 0.016
        self.assertAlmostEqual(steps, round(steps), delta=0.01)
        wait_for("/turtle1/pose", Pose, lambda p: p.linear_velocity == 0)  # a second later
        stop.unregister()

    def test_background_from_parameters(self):
        rospy.set_param("/turtlesim/background_r", 150)
        try:
            call("/clear", Empty)
            wait_for("/turtle1/color_sensor", Color, lambda c: (c.r, c.g, c.b) == (150, 86, 255))
            rospy.set_param("/turtlesim/background_r", "reddish")
            call("/clear", Empty)
            wait_for("/turtle1/color_sensor", Color, lambda c: (c.r, c.g, c.b) == (69, 86, 255))
        finally:
            rospy.set_param("/turtlesim/background_r", 69)

    def test_teleport_and_pen(self):
        call("/turtle1/set_pen", SetPen, 255, 0, 0, 5, 0)
        call("/turtle1/teleport_absolute", TeleportAbsolute, 2, 3, math.pi / 2)
        self.pose(2, 3, math.pi / 2)
        wait_for("/turtle1/color_sensor", Color, lambda c: (c.r, c.g, c.b) == (255, 0, 0))
        call("/turtle1/teleport_relative", TeleportRelative, 2, -math.pi / 2)
        self.pose(4, 3, 0)
        call("/turtle1/set_pen", SetPen, 0, 0, 0, 0, 1)
        call("/turtle1/teleport_relative", TeleportRelative, 1, 0)
        wait_for("/turtle1/color_sensor", Color, lambda c: (c.r, c.g, c.b) == (69, 86, 255))
        with self.assertRaisesRegex(rospy.ServiceException, "not finite"):
            call("/turtle1/teleport_absolute", TeleportAbsolute, math.nan, 3, 0)
        self.pose(5, 3, 0)

    def test_spawn_and_kill(self):
        self.assertEqual(call("/spawn", Spawn, 2, 2, 0.2, "").name, "turtle2")
        pose = wait_for("/turtle2/pose", Pose, lambda p: True)
        self.assertAlmostEqual(pose.theta, 0.2, places=5)
        self.assertEqual(call("/spawn", Spawn, 2, 2, 0.2, "Leo").name, "Leo")
        records = queue.Queue()
        listener = rospy.Subscriber("/rosout", Log, records.put)
        wait_for("/turtle1/pose", Pose, lambda p: listener.get_num_connections() > 0)
        with self.assertRaisesRegex(rospy.ServiceException, r"A turtled named \[Leo\] already exists"):
            call("/spawn", Spawn, 2, 2, 0.2, "Leo")
        wanted = self.log("A turtled named [Leo] already exists", Log.ERROR)
        while not wanted(records.get(timeout=60)):
            pass
        listener.unregister()
        with self.assertRaisesRegex(rospy.ServiceException, "is no name for a turtle"):
            call("/spawn", Spawn, 2, 2, 0.2, "my turtle")
        call("/kill", Kill, "turtle2")
        self.assertNotIn("/turtle2/pose", dict(rospy.get_published_topics()))
        with self.assertRaisesRegex(rospy.ServiceException, r"Tried to kill turtle \[turtle2\], which does not exist"):
            call("/kill", Kill, "turtle2")
        call("/reset", Empty)
        self.assertNotIn("/Leo/pose", dict(rospy.get_published_topics()))
        self.pose(5.544445, 5.544445, 0)

    def test_rostopic_pub_once(self):
        """As in the tutorial: a second of circle."""
        subprocess.run(
            ["rostopic", "pub", "-1", "/turtle1/cmd_vel", "geometry_msgs/Twist", "--", "[2.0, 0.0, 0.0]", "[0.0, 0.0, 1.8]"],
            check=True,
            stdout=subprocess.DEVNULL,
            timeout=100,
        )
        # a second of it: 62 or 63 steps, and one that began before the clock was looked at
        wait_for("/turtle1/pose", Pose, lambda p: 1.6 < p.theta < 2.3 and p.linear_velocity == 0)

    def test_keyboard(self):
        keys = pexpect.spawn("rosrun", ["turtlesim", "turtle_teleop_key"], encoding="utf-8", timeout=60)
        try:
            keys.expect_exact("Reading from keyboard\r\n---------------------------\r\nUse arrow keys to move the turtle. 'q' to quit.")
            for key, ahead, turn in (("\x1b[A", 1.5, 0), ("\x1b[D", 0, 2.0), ("\x1b[C", 0, -2.0), ("x\x1b[B", 1.5, 0)):

                def moves(pose):  # typed again and again: the first comes before the turtle listens
                    if (pose.linear_velocity, pose.angular_velocity) == (ahead, turn):
                        return True
                    keys.send(key)
                    return False

                wait_for("/turtle1/pose", Pose, moves)
            copied = wait_for("/copy/cmd_vel", Twist, lambda t: True)
            self.assertEqual(copied.linear.y, 0)
            keys.send("q")
            keys.expect(pexpect.EOF)
            keys.wait()
            self.assertEqual(keys.exitstatus, 0)
        finally:
            keys.close(force=True)

    def test_mimic(self):
        publisher = rospy.Publisher("/turtle1/cmd_vel", Twist, queue_size=1, latch=True)
        twist = Twist()
        twist.linear.x, twist.angular.z = 0.5, -0.25
        publisher.publish(twist)
        wait_for("/copy/cmd_vel", Twist, lambda t: (t.linear.x, t.angular.z) == (0.5, -0.25))
        publisher.unregister()

    def test_draw_square(self):
        said = queue.Queue()
        listener = rospy.Subscriber("/rosout", Log, lambda record: record.name == "/draw_square" and said.put(record.msg))
        square = subprocess.Popen(["rosrun", "turtlesim", "draw_square"], stdout=subprocess.DEVNULL)
        try:
            self.assertTrue(said.get(timeout=60).startswith("New goal [7.5"))
            self.assertEqual(said.get(timeout=60), "Reached goal")
            self.assertRegex(said.get(timeout=60), r"^New goal \[7\.4\d+ 5\.5\d+, 1\.570796\]$")
            wait_for("/turtle1/pose", Pose, lambda p: abs(p.angular_velocity - 0.4) < 1e-6)
        finally:
            square.terminate()
            square.wait()
            listener.unregister()


if __name__ == "__main__":
    rospy.init_node("turtlesim_rostest")
    rostest.rosrun("turtlesim", "turtlesim", Turtlesim)
