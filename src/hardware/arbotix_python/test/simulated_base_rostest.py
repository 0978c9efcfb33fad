#!/usr/bin/env python3
"""The driver without a board: odometry from velocity commands, frames, joint states, bad configuration."""

import math
import signal
import subprocess
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from ros_helpers import Collector, RunningClock
from sensor_msgs.msg import JointState
from test_support import heading
from tf2_msgs.msg import TFMessage


class SimulatedBase(unittest.TestCase):
    def test_odometry(self):
        odometry = Collector("/odom", Odometry)
        transforms = Collector("/tf", TFMessage)
        commands = rospy.Publisher("/cmd_vel", Twist, queue_size=1, latch=True)
        twist = Twist()
        twist.linear.x, twist.angular.z = 0.5, 0.4
        commands.publish(twist)  # once: in simulation a command holds for ever
        moving = odometry.wait_for(lambda m: m.twist.twist.linear.x == 0.5, "odometry of the command")
        start = moving.header.stamp
        odometry.wait_for(lambda m: (m.header.stamp - start).to_sec() > 4, "odometry four seconds on")

        self.assertEqual((moving.header.frame_id, moving.child_frame_id), ("odom", "base_footprint"))
        run = [m for m in odometry.messages if m.header.stamp >= start]
        for before, after in zip(run, run[1:]):
            period = (after.header.stamp - before.header.stamp).to_sec()
            self.assertGreater(period, 0.1)
            place, then = after.pose.pose.position, before.pose.pose.position
            self.assertAlmostEqual(place.x - then.x, 0.5 * period * math.cos(heading(before.pose.pose.orientation)), places=9)
            self.assertAlmostEqual(place.y - then.y, 0.5 * period * math.sin(heading(before.pose.pose.orientation)), places=9)
            self.assertAlmostEqual(heading(after.pose.pose.orientation) - heading(before.pose.pose.orientation), 0.4 * period, places=9)
        self.assertEqual(run[-1].twist.twist.angular.z, 0.4)

        last = run[-1].pose.pose.position
        message = transforms.wait_for(
            lambda m: abs(m.transforms[0].transform.translation.x - last.x) < 1e-12, "transform of the last odometry"
        )
        transform = message.transforms[0]
        self.assertEqual((transform.header.frame_id, transform.child_frame_id), ("odom", "base_footprint"))
        self.assertAlmostEqual(transform.transform.translation.y, last.y, places=12)

    def test_no_number_is_ignored(self):
        odometry = Collector("/odom", Odometry)
        commands = rospy.Publisher("/cmd_vel", Twist, queue_size=10)
        twist = Twist()
        for value in (math.nan, math.inf, 1e308, 0.25):  # until the last one has come, which is a command
            twist.linear.x = twist.angular.z = value
            odometry.wait_for(lambda m: commands.get_num_connections() > 0, "the driver to listen")
            commands.publish(twist)
        odometry.wait_for(lambda m: m.twist.twist.linear.x == 0.25, "odometry of the command")
        for message in odometry.messages:
            self.assertTrue(math.isfinite(message.pose.pose.position.x + heading(message.pose.pose.orientation)))
        twist.linear.x = twist.angular.z = 0.0
        commands.publish(twist)

    def test_joint_states(self):
        state = Collector("/joint_states", JointState).wait_for(lambda m: True, "joint states")
        self.assertEqual(state.name, ["base_l_wheel_joint", "base_r_wheel_joint"])
        self.assertEqual((state.position, state.velocity, state.effort), ((0, 0), (0, 0), ()))

    def test_diagnostics(self):
        message = Collector("/diagnostics", DiagnosticArray).wait_for(lambda m: True, "diagnostics")
        status = {entry.name: entry for entry in message.status}["base_controller"]
        self.assertEqual([pair.key for pair in status.values], ["dX", "dR"])

    def test_bad_configuration_is_named_and_left_out(self):
        rospy.set_param(
            "/broken",
            {
                "sim": True,
                "controllers": {
                    "wings": {"type": "flapping_controller"},
                    "narrow": {"type": "diff_controller", "ticks_meter": 4100},
                    "head": {"type": "follow_controller", "joints": ["neck"], "action_name": "nod"},
                    "still": {"type": "diff_controller", "ticks_meter": 4100, "base_width": 0.2, "rate": 0},
                    "wordy": {"type": "diff_controller", "ticks_meter": "many", "base_width": 0.2},
                    "tail": {"type": "follow_controller", "joints": "neck"},
                },
                "joints": {"endless": {"id": 1, "range": math.inf}},
            },
        )
        driver = subprocess.Popen(["rosrun", "arbotix_python", "arbotix_driver", "__name:=broken"], stderr=subprocess.PIPE, text=True)
        try:
            states = Collector("/joint_states", JointState)
            states.wait_for(lambda m: m._connection_header["callerid"] == "/broken", "joint states all the same")
        finally:
            driver.send_signal(signal.SIGINT)
            errors = driver.communicate(timeout=60)[1]
        self.assertRegex(errors, "wings has type flapping_controller")
        self.assertRegex(errors, "/broken/controllers/narrow/base_width is not set")
        self.assertRegex(errors, "joint neck of /broken/controllers/head/joints")
        self.assertRegex(errors, "/broken/controllers/still/rate must be a number above 0, it is 0")
        self.assertRegex(errors, "/broken/controllers/wordy/ticks_meter must be a number above 0, it is 'many'")
        self.assertRegex(errors, "/broken/controllers/tail/joints must be a list of names, it is 'neck'")
        self.assertRegex(errors, "/broken/joints/endless/range must be a number above 0, it is inf")
        self.assertNotIn("Traceback", errors)

    def test_a_driver_that_cannot_start_says_why(self):
        rospy.set_param("/halted", {"sim": True, "read_rate": "often"})
        driver = subprocess.run(
            ["rosrun", "arbotix_python", "arbotix_driver", "__name:=halted"], stderr=subprocess.PIPE, text=True, timeout=60
        )
        self.assertEqual(driver.returncode, 1)
        self.assertRegex(driver.stderr, "arbotix cannot start: parameter /halted/read_rate must be a number above 0, it is 'often'")
        self.assertNotIn("Traceback", driver.stderr)


if __name__ == "__main__":
    rospy.init_node("simulated_base_rostest")
    clock = RunningClock()
    rostest.rosrun("arbotix_python", "simulated_base", SimulatedBase)
    clock.stop()
