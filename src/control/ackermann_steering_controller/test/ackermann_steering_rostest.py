#!/usr/bin/env python3
"""Behaviour of the Ackermann steering controller over its topics and tf."""

import math

import rospy
import test_support
from control_test_robots import client
from control_test_robots.base_client import Base, displacement, duration, turned
from nav_msgs.msg import Odometry


class Ackermann(test_support.TestCase):
    def setUp(self):
        client.set_faults()

    def assertDrives(self, name, linear, steer, speed, yaw_rate):
        """Command (linear, steer) and see the base go at ``speed`` and ``yaw_rate``, on an arc."""
        with client.running(name), Base(name) as base:
            messages = base.drive(linear, steer, 3.0)
            time = duration(messages)
            self.assertAlmostEqual(turned(messages), yaw_rate * time, delta=0.01)
            twist = messages[-1].twist.twist
            self.assertAlmostEqual(twist.linear.x, speed, delta=1e-6)
            self.assertAlmostEqual(twist.angular.z, yaw_rate, delta=1e-6)
            x, y = displacement(messages)
            if yaw_rate:
                radius = speed / yaw_rate
                self.assertAlmostEqual(x, radius * math.sin(yaw_rate * time), delta=0.01)
                self.assertAlmostEqual(y, radius * (1.0 - math.cos(yaw_rate * time)), delta=0.01)
            else:
                self.assertAlmostEqual(x, speed * time, delta=0.002)
                self.assertAlmostEqual(y, 0.0, delta=1e-6)

    def test_forward(self):
        self.assertDrives("plain", 0.1, 0.0, 0.1, 0.0)

    def test_turn(self):
        self.assertDrives("plain", 0.3, 0.5, 0.3, 0.3 * math.tan(0.5) / 0.4)

    def test_geometry_from_parameters(self):
        self.assertDrives("by_parameters", 0.3, 0.5, 0.3, 0.3 * math.tan(0.5) / 0.8)

    def test_multipliers_correct_the_odometry_alone(self):
        self.assertDrives("multipliers", 0.3, 0.5, 0.45, 0.45 * math.tan(0.25) / 0.8)

    def test_open_loop_takes_the_command_for_a_yaw_rate(self):
        self.assertDrives("open_loop", 0.3, 0.5, 0.3, 0.5)

    def test_starts_at_the_origin_wherever_the_wheel_is(self):
        with client.running("plain"), Base("plain") as base:
            first = base.odometry.messages[0]
            self.assertEqual((first.pose.pose.position.x, first.pose.pose.position.y), (0.0, 0.0))
            self.assertEqual((first.header.frame_id, first.child_frame_id), ("odom", "base_link"))
            client.wait_until(lambda: ("odom", "base_link") in base.transforms(), "the transform")

    def test_frames_by_parameter(self):
        with client.running("frames"), Base("frames") as base:
            self.assertEqual(base.odometry.last.header.frame_id, "map")
            client.wait_until(lambda: ("map", "base_footprint") in base.transforms(), "the transform")

    def test_transform_can_be_left_out(self):
        with client.running("no_tf"), Base("no_tf") as base:
            client.sim_sleep(1.0)
            self.assertEqual(base.transforms(), set())

    def test_a_command_runs_out(self):
        with client.running("timeout"), Base("timeout") as base:
            base.odometry.clear()
            base.send(1.0, 0.0)
            client.sim_sleep(3.0)
            self.assertAlmostEqual(displacement(base.odometry.messages)[0], 0.5, delta=0.03)

    def test_limits(self):
        with client.running("limits"), Base("limits") as base:
            odometry = base.topic("odom", Odometry)
            base.drive(10.0, 10.0, 2.0)
            twists = [(m.header.stamp.to_sec(), m.twist.twist) for m in odometry.messages]
        self.assertEqual((twists[-1][1].linear.x, twists[-1][1].angular.z), (1.0, 0.5))
        start = next(time for time, twist in twists if twist.linear.x > 0.0) - 0.01
        then = next(twist for time, twist in twists if time > start + 0.5 - 1e-6)
        self.assertAlmostEqual(then.linear.x, 0.5, delta=0.021)
        self.assertAlmostEqual(then.angular.z, 0.25, delta=0.011)

    def test_commands_that_are_not_numbers_are_ignored(self):
        with client.running("plain"), Base("plain") as base:
            base.send(math.nan, 0.0)
            base.send(0.0, math.nan)
            client.sim_sleep(1.0)
            twists = [message.twist.twist for message in base.odometry.messages]
            self.assertTrue(all(twist.linear.x == twist.angular.z == 0.0 for twist in twists))

    def test_wheel_without_a_position_gives_no_odometry_until_it_has_one(self):
        with client.running("plain"), Base("plain") as base:
            client.set_faults(rear_wheel_joint={"nan": True})
            client.sim_sleep(0.5)
            base.odometry.clear()
            client.sim_sleep(0.5)
            self.assertEqual(base.odometry.messages, [])
            client.set_faults()
            self.assertTrue(math.isfinite(base.odometry.next().pose.pose.position.x))

    def test_wrong_parameters_are_refused(self):
        for name in ("wrong_wheel", "wrong_steer", "ball_without_radius", "no_multiplier", "endless_multiplier"):
            with self.subTest(name):
                self.assertFalse(client.loads(name))
                self.assertFalse(client.published(f"/{name}/odom"))


if __name__ == "__main__":
    import rostest

    rospy.init_node("ackermann_steering")
    rostest.rosrun("ackermann_steering_controller", "ackermann_steering", "__main__")
