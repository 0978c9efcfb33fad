#!/usr/bin/env python3
"""Behaviour of the differential drive controller over its topics, tf and dynamic_reconfigure."""

import math
import socket
import subprocess

import rospy
import test_support
from control_msgs.msg import JointTrajectoryControllerState
from control_test_robots import client
from control_test_robots.base_client import Base, displacement, duration, turned
from controller_manager_tests.client import sends
from dynamic_reconfigure.client import Client as ReconfigureClient
from geometry_msgs.msg import TwistStamped
from rosgraph_msgs.msg import Log


class DiffDrive(test_support.TestCase):
    def setUp(self):
        client.set_faults()

    def assertGoesAsTold(self, base):
        """Straight ahead, then round: by what was commanded, and nothing else."""
        messages = base.drive(0.1, 0.0, 5.0)
        x, y = displacement(messages)
        self.assertAlmostEqual(x, 0.1 * duration(messages), delta=0.002)
        self.assertAlmostEqual(y, 0.0, delta=1e-6)
        self.assertAlmostEqual(turned(messages), 0.0, delta=1e-6)
        self.assertAlmostEqual(messages[-1].twist.twist.linear.x, 0.1, delta=1e-6)
        messages = base.drive(0.0, math.pi / 10, 5.0)
        self.assertAlmostEqual(turned(messages), math.pi / 10 * duration(messages), delta=0.01)
        self.assertLess(math.hypot(*displacement(messages)), 1e-6)
        self.assertAlmostEqual(messages[-1].twist.twist.angular.z, math.pi / 10, delta=1e-6)

    def test_goes_as_told_and_describes_itself(self):
        with client.running("plain"), Base("plain") as base:
            first = base.odometry.messages[0]
            self.assertEqual((first.pose.pose.position.x, first.pose.pose.position.y), (0.0, 0.0))
            self.assertEqual((first.header.frame_id, first.child_frame_id), ("odom", "base_link"))
            self.assertEqual(first.pose.covariance[::7], (0.001, 0.001, 1e6, 1e6, 1e6, 0.01))
            self.assertEqual(first.twist.covariance[0], 0.002)
            self.assertGoesAsTold(base)
            self.assertIn(("odom", "base_link"), base.transforms())
            self.assertFalse(client.published("/plain/cmd_vel_out"))
            self.assertFalse(client.published("/plain/wheel_joint_controller_state"))

    def test_circle_comes_back(self):
        with client.running("plain"), Base("plain") as base:
            messages = base.drive(1.0, 2.0, math.pi + 0.1)
            x, y = displacement([m for m in messages if m.header.stamp.to_sec() - messages[0].header.stamp.to_sec() <= math.pi / 2 + 1e-3])
            self.assertAlmostEqual(x, 0.0, delta=0.02)
            self.assertAlmostEqual(y, 1.0, delta=0.01)  # half a turn on a radius of 0.5 m

    def wheels(self, name, linear, angular):
        """Velocities of the wheels in steady motion, rad/s, after checking that the odometry says the same motion."""
        with client.running(name), Base(name) as base:
            wheels = base.topic("wheel_joint_controller_state", JointTrajectoryControllerState)
            messages = base.drive(linear, angular, 1.0)
            self.assertAlmostEqual(turned(messages), angular * duration(messages), delta=0.01)
            state = wheels.next()
            self.assertEqual(len(state.joint_names), len(state.actual.velocities))
            self.assertTrue(all(map(math.isnan, state.desired.effort)))
            for desired, actual in zip(state.desired.velocities, state.actual.velocities):
                self.assertAlmostEqual(desired, actual, delta=1e-6)
            return state.joint_names, state.desired.velocities

    def assertWheels(self, name, left, right):
        _, velocities = self.wheels(name, 0.6, 0.8)
        half = len(velocities) // 2
        for velocity, expected in zip(velocities, [left] * half + [right] * half):
            self.assertAlmostEqual(velocity, expected, delta=1e-6)

    def test_every_wheel_of_a_side_turns_alike(self):
        names, velocities = self.wheels("skid", 0.6, 0.8)
        self.assertEqual(names, [f"{place}_{side}_joint" for side in ("left", "right") for place in ("front", "middle", "back")])
        for velocity, expected in zip(velocities, [4.0] * 3 + [8.0] * 3):
            self.assertAlmostEqual(velocity, expected, delta=1e-6)

    def test_geometry_from_spheres_and_parameters(self):
        self.assertWheels("spheres", 2.0, 4.0)
        self.assertWheels("by_parameters", 0.4, 2.0)
        self.assertWheels("swapped_wheels", 2.0, 0.4)  # a negative separation, as on robots whose sides are confused
        self.assertWheels("noetics_kinds", 0.4, 2.0)  # what roscpp's param() rounds, or takes the default for

    def test_multipliers(self):
        self.assertWheels("multipliers", (0.6 - 0.24) / 0.125, (0.6 + 0.24) / 0.125)
        self.assertWheels("side_multipliers", 0.4 / 0.05, 0.8 / 0.2)

    def test_open_loop_believes_the_command(self):
        client.set_faults(wheel_0_joint={"smoothing": 0.5}, wheel_1_joint={"smoothing": 0.5})
        with client.running("open_loop"), Base("open_loop") as base:
            self.assertGoesAsTold(base)
        with client.running("plain"), Base("plain") as base:  # while closed loop sees that the wheels turn half as fast
            messages = base.drive(0.1, 0.0, 2.0)
            self.assertAlmostEqual(displacement(messages)[0], 0.05 * duration(messages), delta=0.002)

    def test_commands_are_not_held_back(self):
        """TCP would keep one until the last is acknowledged, longer than a command lasts in a fast simulation."""
        with client.running("plain"), Base("plain") as base:
            for connection in base.command.impl.connections:
                self.assertTrue(connection.socket.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY))

    def test_frames_by_parameter(self):
        with client.running("frames"), Base("frames") as base:
            last = base.odometry.last
            self.assertEqual((last.header.frame_id, last.child_frame_id), ("map", "base_footprint"))
            client.wait_until(lambda: ("map", "base_footprint") in base.transforms(), "the transform")

    def test_transform_can_be_switched_off_and_on_again(self):
        with client.running("no_tf"), Base("no_tf") as base:
            client.sim_sleep(1.0)
            self.assertEqual(base.transforms(), set())
            reconfigure = ReconfigureClient("/no_tf", timeout=60.0)
            reconfigure.update_configuration({"enable_odom_tf": True})
            client.wait_until(lambda: ("odom", "base_link") in base.transforms(), "the transform")
            reconfigure.close()

    def test_dynamic_reconfigure(self):
        with client.running("tuned"), Base("tuned") as base:
            reconfigure = ReconfigureClient("/tuned", timeout=60.0)
            parameters = reconfigure.get_parameter_descriptions()
            self.assertEqual(
                [(p["name"], p["default"]) for p in parameters],
                [
                    ("left_wheel_radius_multiplier", 1.0),
                    ("right_wheel_radius_multiplier", 1.0),
                    ("wheel_separation_multiplier", 1.0),
                    ("publish_rate", 50.0),
                    ("enable_odom_tf", True),
                ],
            )
            before = base.odometry.next()
            new = {
                "left_wheel_radius_multiplier": 0.95,
                "right_wheel_radius_multiplier": 0.95,
                "wheel_separation_multiplier": 1.1,
                "publish_rate": 10.0,
                "enable_odom_tf": False,
            }
            echo = reconfigure.update_configuration(new)
            self.assertEqual({name: echo[name] for name in new}, new)
            base.odometry.clear()
            client.sim_sleep(2.0)
            base.odometry.next()  # those before have arrived
            stamps = [message.header.stamp.to_sec() for message in base.odometry.messages]
            recent = [stamp for stamp in stamps if stamp > stamps[-1] - 1.5]  # the first may have been on their way before
            self.assertAlmostEqual(len(recent), 15, delta=2)
            self.assertEqual(base.odometry.last.pose.pose.position, before.pose.pose.position)  # new radii move nothing
            reconfigure.close()

    def test_a_command_runs_out(self):
        with client.running("timeout"), Base("timeout") as base:
            base.odometry.clear()
            base.send(1.0, 0.0)
            client.sim_sleep(3.0)
            x, _ = displacement(base.odometry.messages)
            self.assertAlmostEqual(x, 0.5, delta=0.03)

    def test_reset_simulation_moves_nothing(self):
        with client.running("plain"), Base("plain") as base:
            base.drive(1.0, 0.5, 3.0)
            base.send(0.5, 0.5)
            client.wait_until(lambda: abs(base.odometry.last.twist.twist.linear.x - 0.5) < 1e-6, "the last command")
            before = base.odometry.next().pose.pose.position
            client.reset()
            base.odometry.clear()
            client.sim_sleep(1.0)
            self.assertGreater(len(base.odometry.messages), 20)  # of the 100 that a second has; it goes on being published
            last = base.odometry.last
            self.assertLess(math.hypot(last.pose.pose.position.x - before.x, last.pose.pose.position.y - before.y), 0.2)
            self.assertEqual(last.twist.twist.linear.x, 0.0)  # the command was one of the time before
            self.assertAlmostEqual(base.drive(0.5, 0.0, 0.5)[-1].twist.twist.linear.x, 0.5, delta=1e-6)

    def test_stopped_controller_ignores_commands(self):
        with client.running("plain"), Base("plain") as base:
            base.drive(1.0, 0.0, 0.5)
            log = client.Topic("/rosout", Log)
            client.wait_until(lambda: sends("/test_robot", "/rosout"), "the robot's log")
            client.switch(stop=["plain"])
            base.send(1.0, 0.0)
            client.wait_until(lambda: any("Controller is not running" in line.msg for line in log.messages), "the refusal")
            log.close()
            client.switch(["plain"])
            base.odometry.clear()
            client.sim_sleep(1.0)
            self.assertEqual(displacement(base.odometry.messages), (0.0, 0.0))

    def ramp(self, name, linear, angular, seconds):
        """cmd_vel_out ``seconds`` after the command came into force, and at the end."""
        with client.running(name), Base(name) as base:
            out = base.topic("cmd_vel_out", TwistStamped)
            base.drive(linear, angular, seconds + 0.5)
            moving = [m for m in out.messages if m.twist.linear.x or m.twist.angular.z]
            start = moving[0].header.stamp.to_sec() - 0.01
            then = next(m for m in moving if m.header.stamp.to_sec() >= start + seconds - 1e-6)
            return then.twist.linear.x, then.twist.angular.z

    def test_velocity_limits(self):
        self.assertEqual(self.ramp("velocity_limits", 10.0, 10.0, 0.1), (1.0, 2.0))
        self.assertEqual(self.ramp("velocity_limits", -10.0, -10.0, 0.1), (-0.5, -2.0))

    def test_acceleration_limits(self):
        linear, angular = self.ramp("acceleration_limits", 10.0, -10.0, 0.5)
        self.assertAlmostEqual(linear, 0.5, delta=0.021)
        self.assertAlmostEqual(angular, -1.0, delta=0.041)

    def test_jerk_limits(self):
        linear, angular = self.ramp("jerk_limits", 10.0, 10.0, 0.5)
        # a change of at most 2 * jerk * dt^2 in each step's change: after 50 steps 50 * 51 * jerk * dt^2
        self.assertAlmostEqual(linear, 50 * 51 * 5.0 * 1e-4, delta=0.06)
        self.assertAlmostEqual(angular, 50 * 51 * 10.0 * 1e-4, delta=0.12)

    def test_a_limit_without_a_maximum_is_zero(self):
        with client.running("no_maximum"), Base("no_maximum") as base:
            self.assertEqual(base.drive(1.0, 0.0, 0.5, obeys=False)[-1].twist.twist.linear.x, 0.0)

    def test_commands_that_are_not_numbers_are_ignored(self):
        with client.running("velocity_limits"), Base("velocity_limits") as base:
            out = base.topic("cmd_vel_out", TwistStamped)
            for linear, angular in ((math.nan, 0.0), (0.0, math.nan), (math.inf, 0.0), (1e308, 1e308)):
                base.send(linear, angular)
            client.sim_sleep(1.0)
            self.assertTrue(all(m.twist.linear.x == m.twist.angular.z == 0.0 for m in out.messages))
            self.assertTrue(all(m.twist.twist.linear.x == 0.0 for m in base.odometry.messages))

    def test_wheels_without_a_position_give_no_odometry_until_they_have_one(self):
        with client.running("plain"), Base("plain") as base:
            base.drive(0.5, 0.0, 0.5)
            client.set_faults(wheel_0_joint={"nan": True})
            client.sim_sleep(0.5)
            base.odometry.clear()
            client.sim_sleep(0.5)
            self.assertEqual(base.odometry.messages, [])
            client.set_faults()
            position = base.odometry.next().pose.pose.position
            self.assertTrue(math.isfinite(position.x) and math.isfinite(position.y))

    def test_two_publishers_where_one_is_allowed_stop_the_robot(self):
        with client.running("one_publisher"), Base("one_publisher") as base:
            self.assertAlmostEqual(base.drive(0.5, 0.0, 1.0)[-1].twist.twist.linear.x, 0.5, delta=1e-6)
            base.wait_at_rest()  # the command has run out
            second = subprocess.Popen(
                ["rostopic", "pub", "--latch", "/one_publisher/cmd_vel", "geometry_msgs/Twist", "{}"],
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
            try:
                client.wait_until(lambda: client.publisher_count("/one_publisher/cmd_vel") == 2, "the second publisher", 600.0)
                client.wait_until(
                    lambda: base.drive(0.5, 0.0, 1.0, obeys=False)[-1].twist.twist.linear.x == 0.0, "the robot to stop", 600.0
                )
            finally:
                second.terminate()
                second.wait()

    def test_wrong_parameters_are_refused(self):
        for name in (
            "wrong_joint",
            "square_wheels",
            "no_wheels",
            "uneven",
            "zero_radius",
            "short_covariance",
            "nan_radius",
            "endless_separation",
            "no_multiplier",
            "nan_covariance",
        ):
            with self.subTest(name):
                self.assertFalse(client.loads(name))
                self.assertFalse(client.published(f"/{name}/odom"))


if __name__ == "__main__":
    import rostest

    rospy.init_node("diff_drive")
    rostest.rosrun("diff_drive_controller", "diff_drive", "__main__")
