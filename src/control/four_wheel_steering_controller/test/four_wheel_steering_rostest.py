#!/usr/bin/env python3
"""Behaviour of the four wheel steering controller over its topics and tf."""

import math

import rospy
import test_support
from control_test_robots import client
from control_test_robots.base_client import Base, displacement, duration, turned
from four_wheel_steering_msgs.msg import FourWheelSteering, FourWheelSteeringStamped


class FourWheels(test_support.TestCase):
    def setUp(self):
        client.set_faults()

    def steer(self, base, seconds, obeys=True, **command):
        """Odometry of ``seconds`` under a steering command."""
        publisher = client.publisher(f"/{base.name}/cmd_four_wheel_steering", FourWheelSteering)
        messages = base.follow(lambda: publisher.publish(FourWheelSteering(**command)), seconds, obeys)
        publisher.unregister()
        return messages

    def test_forward(self):
        with client.running("plain"), Base("plain") as base:
            messages = base.drive(0.3, 0.0, 3.0)
            x, y = displacement(messages)
            self.assertAlmostEqual(x, 0.3 * duration(messages), delta=0.005)
            self.assertAlmostEqual(y, 0.0, delta=1e-6)
            self.assertAlmostEqual(turned(messages), 0.0, delta=1e-6)
            self.assertAlmostEqual(messages[-1].twist.twist.linear.x, 0.3, delta=1e-6)

    def test_turn_by_twist(self):
        with client.running("plain"), Base("plain") as base:
            messages = base.drive(1.0, math.pi / 10, 3.0)
            self.assertAlmostEqual(turned(messages), math.pi / 10 * duration(messages), delta=0.01)
            self.assertAlmostEqual(messages[-1].twist.twist.linear.x, 1.0, delta=0.005)

    def test_crab(self):
        with client.running("plain"), Base("plain") as base:
            angle = math.pi / 6
            messages = self.steer(base, 3.0, speed=0.5, front_steering_angle=angle, rear_steering_angle=angle)
            x, y = displacement(messages)
            self.assertAlmostEqual(x, 0.5 * math.cos(angle) * duration(messages), delta=0.01)
            self.assertAlmostEqual(y, 0.5 * math.sin(angle) * duration(messages), delta=0.01)
            self.assertAlmostEqual(turned(messages), 0.0, delta=1e-6)

    def test_symmetric_turn(self):
        self.assertTurns(0.3, -0.3)

    def test_asymmetric_turn(self):
        self.assertTurns(-0.35, 0.2)

    def assertTurns(self, front, rear):
        with client.running("plain"), Base("plain") as base:
            state = base.topic("odom_steer", FourWheelSteeringStamped)
            messages = self.steer(base, 3.0, speed=1.0, front_steering_angle=front, rear_steering_angle=rear)
            angle = (math.tan(front) - math.tan(rear)) / 1.4 * duration(messages)
            self.assertAlmostEqual(turned(messages), angle, delta=0.02 * abs(angle))
            self.assertAlmostEqual(state.last.data.front_steering_angle, front, delta=1e-4)
            self.assertAlmostEqual(state.last.data.rear_steering_angle, rear, delta=1e-4)
            self.assertAlmostEqual(state.last.data.speed, 1.0, delta=0.03)
            rising = max(message.data.front_steering_angle_velocity * front for message in state.messages)
            self.assertGreater(rising, 0.0)  # the rate has the sign of the motion

    def test_newest_kind_of_command_counts_and_runs_out(self):
        with client.running("plain"), Base("plain") as base:
            self.steer(base, 0.5, speed=1.0, front_steering_angle=0.5, rear_steering_angle=0.5)
            messages = base.drive(0.3, 0.0, 1.0)
            self.assertAlmostEqual(messages[-1].twist.twist.linear.y, 0.0, delta=1e-6)
            self.assertAlmostEqual(messages[-1].twist.twist.linear.x, 0.3, delta=1e-6)
            base.wait_at_rest()

    def test_limits(self):
        with client.running("limits"), Base("limits") as base:
            self.assertAlmostEqual(base.drive(5.0, 0.0, 2.0)[-1].twist.twist.linear.x, 0.5, delta=1e-6)
            base.wait_at_rest()
            messages = self.steer(base, 2.0, speed=5.0)
            self.assertAlmostEqual(messages[-1].twist.twist.linear.x, 0.5, delta=1e-6)

    def test_commands_that_are_not_numbers_are_ignored(self):
        with client.running("plain"), Base("plain") as base:
            base.send(math.nan, 0.0)
            messages = self.steer(base, 0.5, obeys=False, speed=math.nan)
            messages += self.steer(base, 0.5, obeys=False, speed=1.0, rear_steering_angle=math.nan)
            self.assertTrue(all(m.twist.twist.linear.x == 0.0 for m in messages))

    def test_odometry_frames(self):
        with client.running("plain"), Base("plain") as base:
            client.wait_until(lambda: ("odom", "base_link") in base.transforms(), "the transform")
            last = base.odometry.last
            self.assertEqual((last.header.frame_id, last.child_frame_id), ("odom", "base_link"))
        with client.running("no_tf"), Base("no_tf") as base:
            client.sim_sleep(1.0)
            self.assertEqual(base.transforms(), set())

    def test_geometry_found_in_the_urdf_becomes_parameters(self):
        with client.running("plain"):
            for name, value in (("track", 1.2), ("wheel_base", 1.4), ("wheel_radius", 0.2), ("wheel_steering_y_offset", 0.1)):
                self.assertAlmostEqual(rospy.get_param("/plain/" + name), value)

    def test_wrong_parameters_are_refused(self):
        for name in ("wrong_wheel", "one_wheel", "wrong_base"):
            with self.subTest(name):
                self.assertFalse(client.loads(name))
                self.assertFalse(client.published(f"/{name}/odom"))


if __name__ == "__main__":
    import rostest

    rospy.init_node("four_wheel_steering")
    rostest.rosrun("four_wheel_steering_controller", "four_wheel_steering", "__main__")
