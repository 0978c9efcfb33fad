#!/usr/bin/env python3
"""Pose tracking on the arm of servo_rostest.py. Expected is what the gains give on paper: a twist of p * error + i * sum + d * change,
and behind a target of speed v a lag of v / p, of which the integral takes up to its limit."""

import os
import subprocess
import unittest

import numpy as np
import rospy
import rostest
import tf2_ros
import yaml
from geometry_msgs.msg import Point, PoseStamped, Quaternion, TransformStamped, TwistStamped
from rosgraph_msgs.msg import Log
from servo_rostest import HOME, PERIOD, Arm, tip
from std_msgs.msg import Float64MultiArray, Int8
from std_srvs.srv import SetBool, Trigger
from test_support.hearing import deliver, heard
from test_support.waiting import wait_until

HERE = os.path.dirname(os.path.abspath(__file__))
SUCCESS, NO_RECENT_TARGET_POSE, STOP_REQUESTED = 0, 1, 3  # of moveit_servo::PoseTrackingStatusCode
LATE = 6 * PERIOD  # s that a message, the loop, the smoothing and the arm take together


def quaternion(rotation):
    """(w, x, y, z) of a rotation of less than half a turn."""
    w = np.sqrt(1 + np.trace(rotation)) / 2
    return w, *(np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]]) / (4 * w))


def turned(angle):
    """About z, rad."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def angle_between(one, two):
    return np.arccos(np.clip((np.trace(one @ two.T) - 1) / 2, -1, 1))


class Tracking(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.arm = Arm()
        cls.twists, cls.outcomes, cls.lines = [], [], []
        listeners = [
            rospy.Subscriber("/tracker/delta_twist_cmds", TwistStamped, cls.twists.append, tcp_nodelay=True),
            rospy.Subscriber("/tracker/outcome", Int8, lambda message: cls.outcomes.append(message.data), tcp_nodelay=True),
        ]
        cls.rosout = rospy.Subscriber("/rosout", Log, lambda message: cls.lines.append(message.msg))
        cls.targets = rospy.Publisher("/tracker/target_pose", PoseStamped, queue_size=10, tcp_nodelay=True)
        cls.moves = rospy.Publisher("/tracker/move", Float64MultiArray, queue_size=1)
        cls.gains = rospy.Publisher("/tracker/gains", Float64MultiArray, queue_size=1)
        cls.transforms = tf2_ros.StaticTransformBroadcaster()
        table = TransformStamped()  # 0.3 m in front, a quarter of a turn to the left
        table.header.frame_id, table.child_frame_id = "base_link", "table"
        table.transform.translation.x = 0.3
        table.transform.rotation = Quaternion(0, 0, np.sqrt(0.5), np.sqrt(0.5))
        cls.transforms.sendTransform(table)
        cls.arm.lead("tracker")
        ends = (cls.targets, cls.moves, cls.gains)
        wait_until(lambda: cls.arm.tick() or heard(listeners) and all(end.get_num_connections() for end in ends), "the tracker")

    def setUp(self):
        self.arm.follows = True
        self.arm.put(HOME)
        self.call("reset")
        self.rotation, self.start = tip(HOME)

    def call(self, name, kind=Trigger, *values):
        return rospy.ServiceProxy(f"/tracker/{name}", kind)(*values)

    def point(self, position, rotation=None, frame="base_link", age=0.0):
        target = PoseStamped()
        target.header.frame_id, target.header.stamp = frame, rospy.Time(0, self.arm.now) - rospy.Duration(age)
        w, x, y, z = quaternion(self.rotation if rotation is None else rotation)
        target.pose.position, target.pose.orientation = Point(*position), Quaternion(x, y, z, w)
        self.targets.publish(target)

    def begin(self, *target, position=0.01, angle=0.05, timeout=1.0, **options):
        """A motion, from its first twist on or till its end."""
        self.outcomes.clear()
        self.twists.clear()
        self.moves.publish(data=[position] * 3 + [angle, timeout])

        def begun():
            if target:
                self.point(*target, **options)
            self.arm.step()
            return self.twists or self.outcomes

        wait_until(begun, "the motion")

    def step(self, target=None):
        """One period, in which the loop has made its twist; false when the motion has ended."""
        said = len(self.twists)
        if target is not None:
            self.point(target)
        self.arm.step()
        wait_until(lambda: self.outcomes or len(self.twists) > said, "a twist", interval=0.001)
        return not self.outcomes

    def ends(self, seconds=20.0):
        """The outcome, within so long."""
        for _ in range(round(seconds / PERIOD)):
            if not self.step():
                return self.outcomes[0]
        return self.fail(f"it does not end within {seconds} s")

    def stop(self):
        self.call("stop")
        self.assertEqual(self.ends(1.0), STOP_REQUESTED)

    def linear(self, number):
        v = self.twists[number].twist.linear
        return np.array([v.x, v.y, v.z])

    def tell_gains(self, values):
        """All of them; they have arrived when this returns."""
        deliver(self.gains, Float64MultiArray(data=values))

    def assert_stands(self):
        stays = self.arm.q.copy()
        self.arm.step(20)
        np.testing.assert_allclose(self.arm.q, stays, atol=2e-3)  # it may have been on its way still
        stays = self.arm.q.copy()
        self.arm.step(20)
        np.testing.assert_array_equal(self.arm.q, stays)

    # ------------------------------------------------------------ the controllers

    def test_the_gains_are_those_of_the_parameters(self):
        self.arm.follows = False  # the errors stay as they are
        error = np.array([0.05, 0.03, -0.04])
        self.begin(self.start + error, turned(0.3) @ self.rotation)
        while len(self.twists) < 80:
            self.step()
        x, y, z = error
        for number in range(1, 31):
            integral = min(4.0 * y * number * PERIOD, 0.05)
            expected = [2.0 * x, 3.0 * y + integral, (2.5 + (0.02 / PERIOD if number == 1 else 0)) * z]
            np.testing.assert_allclose(self.linear(number - 1), expected, atol=1e-6)
        np.testing.assert_allclose(self.linear(60), [2.0 * x, 3.0 * y + 0.05, 2.5 * z], atol=1e-6)  # windup_limit
        rate = self.twists[0].twist.angular
        np.testing.assert_allclose([rate.x, rate.y, rate.z], [0, 0, 1.5 * 0.3], atol=1e-6)
        np.testing.assert_allclose([float(word) for word in self.call("errors").message.split()], [x, y, z, 0.3], atol=2e-6)
        self.stop()

        self.begin(self.start + error, turned(0.3) @ self.rotation)
        np.testing.assert_allclose(self.linear(0), [2.0 * x, (3.0 + 4.0 * PERIOD) * y, 4.5 * z], atol=1e-6)  # sums begin anew
        self.tell_gains([1.0, 0, 0, 0.5, 0, 0, 0.25, 0, 0, 2.0, 0, 0])
        self.addCleanup(self.tell_gains, [2.0, 0, 0, 3.0, 4.0, 0, 2.5, 0, 0.02, 1.5, 0, 0])
        self.assertEqual(self.ends(5.0), STOP_REQUESTED)
        self.begin(self.start + error, turned(0.3) @ self.rotation)
        np.testing.assert_allclose(self.linear(0), [x, 0.5 * y, 0.25 * z], atol=1e-6)
        self.assertAlmostEqual(self.twists[0].twist.angular.z, 2.0 * 0.3, places=6)
        self.stop()

    # ------------------------------------------------------------ motions

    def test_it_follows_a_target_that_moves_and_arrives_where_it_ends(self):
        speed = np.array([-0.04, 0.08, 0.05])  # m/s
        self.begin(self.start, position=0.0)  # it is never near enough
        for number in range(1, 251):
            target = self.start + speed * number * PERIOD
            self.assertTrue(self.step(target))
        lag = target - tip(self.arm.q)[1]
        np.testing.assert_array_less(np.abs(lag - [-0.04 / 2.0, (0.08 - 0.05) / 3.0, 0.05 / 2.5]), np.abs(speed) * LATE)
        self.stop()
        self.assert_stands()
        self.begin(target)
        self.assertEqual(self.ends(), SUCCESS)
        self.assert_stands()
        rotation, position = tip(self.arm.q)
        np.testing.assert_array_less(np.abs(position - target), 0.01 + 0.001)
        self.assertLess(angle_between(rotation, self.rotation), 0.05)

    def test_the_tolerance_of_the_angle(self):
        wanted = turned(0.3) @ self.rotation
        self.begin(self.start, wanted, angle=0.5)
        self.assertEqual(self.ends(1.0), SUCCESS)
        self.assert_stands()
        self.assertGreater(angle_between(tip(self.arm.q)[0], wanted), 0.27)
        self.begin(self.start, wanted, angle=0.1)
        self.assertEqual(self.ends(), SUCCESS)
        self.assert_stands()
        left = angle_between(tip(self.arm.q)[0], wanted)
        self.assertLess(left, 0.1)
        self.assertGreater(left, 0.1 - 1.5 * 0.1 * LATE)
        np.testing.assert_allclose(tip(self.arm.q)[1], self.start, atol=0.003)

    def test_a_target_in_another_frame(self):
        target = self.start + [0.0, 0.05, -0.05]
        in_table = turned(-np.pi / 2) @ (target - [0.3, 0, 0])
        self.begin(in_table, turned(-np.pi / 2) @ self.rotation, frame="table")
        self.assertEqual(self.ends(), SUCCESS)
        self.assert_stands()
        np.testing.assert_array_less(np.abs(tip(self.arm.q)[1] - target), 0.01 + 0.001)

    def test_what_is_no_target_changes_nothing(self):
        target = self.start + [0.0, 0.05, 0.0]
        self.begin(target)
        self.point([float("nan"), 0, 0])
        self.point(self.start, rotation=np.full((3, 3), np.nan))
        self.point(self.start, frame="nowhere")
        self.assertEqual(self.ends(), SUCCESS)
        np.testing.assert_array_less(np.abs(tip(self.arm.q)[1] - target), 0.01 + 0.001)
        wait_until(lambda: any("A target pose is skipped: nan" in line for line in self.lines), "the line")
        wait_until(lambda: any("nowhere" in line for line in self.lines), "the line about the frame")

    # ------------------------------------------------------------ ends

    def test_without_a_target_it_does_not_begin(self):
        for age in (None, 2.0):  # none, and one that is too old
            begin = self.arm.now
            self.begin(*([] if age is None else [self.start + [0, 0.1, 0]]), timeout=0.5, **({} if age is None else {"age": age}))
            self.assertEqual((self.outcomes, self.twists), ([NO_RECENT_TARGET_POSE], []))
            self.assertGreaterEqual((self.arm.now - begin) * 1e-9, 0.5)
            np.testing.assert_allclose(self.arm.q, HOME, atol=1e-9)
        wait_until(lambda: any("The target pose was not updated for 0.5 s" in line for line in self.lines), "the line")

    def test_a_target_that_is_lost_on_the_way_is_reached(self):
        """As upstream: its age counts when the motion begins."""
        target = self.start + [0, 0.1, 0]
        self.begin(target, timeout=0.2, position=0.002)
        begin = self.arm.now
        self.assertEqual(self.ends(), SUCCESS)
        self.assertGreater((self.arm.now - begin) * 1e-9, 0.5)

    def test_a_stop_ends_the_motion(self):
        self.begin(self.start + [0, 0.2, 0])
        for _ in range(30):
            self.assertTrue(self.step())
        self.assertGreater(tip(self.arm.q)[1][1], 0.02)
        self.stop()
        self.assert_stands()
        self.assertLess(tip(self.arm.q)[1][1], 0.19)
        self.begin(self.start + [0, 0.2, 0])  # a stop of before does not end the next
        self.assertEqual(self.ends(), SUCCESS)

    def test_paused_it_does_not_move(self):
        self.call("pause", SetBool, True)
        self.addCleanup(self.call, "pause", SetBool, False)
        self.begin(self.start + [0, 0.1, 0])
        said = len(self.arm.commands)
        for _ in range(50):
            self.assertTrue(self.step())
        np.testing.assert_array_equal(self.arm.q, HOME)
        self.assertEqual(len(self.arm.commands), said)
        self.call("pause", SetBool, False)
        for _ in range(50):
            self.step()
        self.assertGreater(tip(self.arm.q)[1][1], 0.02)
        self.call("pause", SetBool, True)  # on the way
        for _ in range(10):
            self.step()
        self.assert_stands()
        self.call("pause", SetBool, False)
        self.assertEqual(self.ends(), SUCCESS)


class Programs(unittest.TestCase):
    """The examples, as they are started on the command line."""

    def run_it(self, node, *command):
        """Until it ends; what it said in ``lines``, and the targets it gave in ``targets``."""
        arm, self.targets, self.lines = Tracking.arm, [], []
        self.subscribers = [
            rospy.Subscriber(f"/{node}/target_pose", PoseStamped, self.targets.append),
            rospy.Subscriber("/rosout", Log, lambda message: self.lines.append(message.msg)),
        ]
        process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.addCleanup(process.kill)
        arm.lead(node)
        while process.poll() is None:
            said = len(arm.statuses)
            arm.tick()
            wait_until(lambda said=said: len(arm.statuses) > said or process.poll() is not None, node, interval=0.001)
        output = process.communicate()[0]
        self.assertEqual(process.returncode, 0, output)
        return output

    def place(self, q):
        Tracking.arm.follows = True
        Tracking.arm.lead("tracker")
        Tracking.arm.put(q)
        return tip(np.array(q))[1]

    def test_the_example_of_pose_tracking(self):
        start = self.place([0.0, -0.3, 2.1, 0.0, 1.0, 0.0])
        self.run_it("servo_server", "roslaunch", "moveit_servo", "pose_tracking_example.launch", f"config:={HERE}/servo.yaml")
        last = self.targets[-1].pose.position
        np.testing.assert_allclose([last.x, last.y, last.z], start + [0.1, 0, 500 * 0.0004], atol=1e-6)
        lag = np.array([last.x, last.y, last.z]) - tip(Tracking.arm.q)[1]
        np.testing.assert_allclose(lag[:2], 0, atol=0.01)
        self.assertAlmostEqual(lag[2], 0.02 / 1.5, delta=0.02 * 2 * LATE)  # 50 targets a second are 0.02 m/s
        wait_until(lambda: "Pose tracking: Stop requested" in self.lines, "its outcome")

    def test_the_example_of_servoing(self):
        start = self.place(HOME)
        self.run_it("servo_server", "roslaunch", "moveit_servo", "cpp_interface_example.launch", f"config:={HERE}/servo.yaml")
        # 2 s of 0.01 m/s to the left and down, then 2 s of 0.2 rad/s of the third joint, which does not move the tip aside
        self.assertAlmostEqual((tip(Tracking.arm.q)[1] - start)[1], 0.02, delta=0.004)
        self.assertAlmostEqual(Tracking.arm.q[2] - HOME[2], 0.4, delta=0.08)

    def test_gains_that_are_missing_or_no_numbers(self):
        parameters = yaml.safe_load(open(f"{HERE}/servo.yaml")) | yaml.safe_load(open(f"{HERE}/pose_tracking.yaml"))
        parameters["angular_integral_gain"] = "much"
        del parameters["x_proportional_gain"], parameters["windup_limit"]
        rospy.set_param("/refused", parameters)
        command = ["rosrun", "moveit_servo", "pose_tracking_example", "__name:=refused"]
        ended = subprocess.run(command, capture_output=True, text=True, timeout=60)
        errors = sorted(line.split("]: ")[-1] for line in (ended.stdout + ended.stderr).splitlines() if "ERROR" in line or "FATAL" in line)
        self.assertEqual(ended.returncode, 1, ended.stderr)
        self.assertEqual(len(errors), 3, errors)
        for line, words in zip(
            errors, ("angular_integral_gain is not a number", "windup_limit is missing", "x_proportional_gain is missing")
        ):
            self.assertIn(words, line)


class AllTests(unittest.TestSuite):
    def __init__(self):
        load = unittest.defaultTestLoader.loadTestsFromTestCase
        super().__init__([load(case) for case in (Tracking, Programs)])


if __name__ == "__main__":
    rospy.init_node("pose_tracking_test")
    rostest.rosrun("moveit_servo", "pose_tracking", "pose_tracking_rostest.AllTests")
